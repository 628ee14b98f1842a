// SPDX-License-Identifier: GPL-3.0-or-later
#include "pqAtriaToolBar.h"

#include <pqActiveObjects.h>
#include <pqApplicationCore.h>
#include <pqCoreUtilities.h>
#include <pqFiltersMenuReaction.h>
#include <pqLoadDataReaction.h>
#include <pqOutputPort.h>
#include <pqPipelineFilter.h>
#include <pqPipelineSource.h>
#include <pqRenderView.h>
#include <pqSaveDataReaction.h>
#include <pqServer.h>
#include <pqServerManagerModel.h>
#include <vtkSMInputProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMPropertyIterator.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMSourceProxy.h>
#include <vtkSMVectorProperty.h>
#include <vtkSmartPointer.h>

#include <QAction>
#include <QIcon>
#include <QMainWindow>
#include <QTimer>

#include <utility>

namespace {

/// True if the filter accepts the data of the port.
bool accepts(const QString& filter, pqOutputPort* port)
{
  if (!port || port->getSource()->modifiedState() == pqProxy::UNINITIALIZED)
  {
    return false;
  }
  vtkSMSessionProxyManager* proxies = port->getServer()->proxyManager();
  vtkSMProxy* prototype = proxies->GetPrototypeProxy("filters", filter.toUtf8().constData());
  auto* input = vtkSMInputProperty::SafeDownCast(prototype ? prototype->GetProperty("Input") : nullptr);
  if (!input)
  {
    return false;
  }
  input->RemoveAllUncheckedProxies();
  input->AddUncheckedInputConnection(port->getSource()->getProxy(), static_cast<unsigned int>(port->getPortNumber()));
  const bool accepted = input->IsInDomains() != 0;
  input->RemoveAllUncheckedProxies();
  return accepted;
}

/// Returns the filter's first input, null for a source.
pqOutputPort* upstreamOf(pqOutputPort* port)
{
  auto* filter = qobject_cast<pqPipelineFilter*>(port->getSource());
  const QList<pqOutputPort*> inputs = filter ? filter->getInputs() : QList<pqOutputPort*>();
  return inputs.isEmpty() ? nullptr : inputs.first();
}

/// Returns the nearest port, from this one upstream, that the filter accepts; null if there is none. The mesher thus
/// finds the model behind the table of a preflight, or behind a mesh.
pqOutputPort* inputOf(const QString& filter, pqOutputPort* port)
{
  while (port && !accepts(filter, port))
  {
    port = upstreamOf(port);
  }
  return port;
}

/// Gives a mesher the properties of a preflight, and the sizes that it found.
void handOver(vtkSMProxy* preflight, vtkSMProxy* mesher)
{
  vtkSmartPointer<vtkSMPropertyIterator> it;
  it.TakeReference(preflight->NewPropertyIterator());
  for (it->Begin(); !it->IsAtEnd(); it->Next())
  {
    vtkSMProperty* source = it->GetProperty();
    vtkSMProperty* target = mesher->GetProperty(it->GetKey());
    if (target && !source->GetInformationOnly() && vtkSMVectorProperty::SafeDownCast(source))
    {
      target->Copy(source);
    }
  }
  preflight->UpdatePropertyInformation();
  const vtkSMPropertyHelper taken(preflight, "SizesTaken");
  for (const auto& [i, name] : {std::pair(0u, "SizeMax"), std::pair(1u, "SizeMid"), std::pair(2u, "SizeMin")})
  {
    if (taken.GetNumberOfElements() == 3 && taken.GetAsDouble(i) > 0.0)
    {
      vtkSMPropertyHelper(mesher, name).Set(taken.GetAsDouble(i));
    }
  }
  mesher->UpdateVTKObjects();
}

/// Activates a render view. Data is shown in the active view, and a table takes anything.
void activateRenderView()
{
  pqActiveObjects& active = pqActiveObjects::instance();
  if (!qobject_cast<pqRenderView*>(active.activeView()))
  {
    const QList<pqRenderView*> views =
        pqApplicationCore::instance()->getServerManagerModel()->findItems<pqRenderView*>(active.activeServer());
    if (!views.isEmpty())
    {
      active.setActiveView(views.first());
    }
  }
}

/// Makes the filter behind the selection, or behind the nearest port upstream that it accepts.
void createStep(const QString& filter)
{
  pqActiveObjects& active = pqActiveObjects::instance();
  pqOutputPort* selected = active.activePort();
  pqOutputPort* input = inputOf(filter, selected);
  if (!input)
  {
    return;
  }
  vtkSMProxy* before = selected->getSource()->getProxy();
  const bool isPreflight = QString(before->GetXMLName()) == "AtriaPreflight";
  activateRenderView();
  if (input != selected)
  {
    active.setActivePort(input);
  }
  pqPipelineSource* made = pqFiltersMenuReaction::createFilter("filters", filter);
  if (made && isPreflight && filter == "AtriaDualMesher")
  {
    handOver(before, made->getProxy());
  }
}

} // namespace

pqAtriaToolBar::pqAtriaToolBar(QWidget* parent) : QToolBar(tr("Atria: From Model to Case"), parent)
{
  this->setObjectName("AtriaSteps");
  this->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  QAction* open = this->addAction(QIcon(":/pqWidgets/Icons/pqOpen.svg"), tr("1 Model"));
  open->setObjectName("AtriaOpen");
  open->setToolTip(tr("Opens a model."));
  new pqLoadDataReaction(open);
  this->addFilter(tr("2 Preflight"), "AtriaPreflight",
                  tr("Tells domain, blockage, narrow places and number of elements of the model that is selected."));
  this->addFilter(tr("3 Mesh"), "AtriaDualMesher",
                  tr("Meshes the space around the model that is selected, after a preflight with its values."));
  this->addFilter(tr("4 Quality"), "AtriaMeshQuality", tr("Measures the mesh that is selected."));
  QAction* save = this->addAction(QIcon(":/pqWidgets/Icons/pqSave.svg"), tr("5 Case"));
  save->setObjectName("AtriaSave");
  save->setToolTip(
      tr("Saves the mesh that is selected: as an OpenFOAM case where the folder's name ends in .openfoam."));
  new pqSaveDataReaction(save);
  pqActiveObjects& active = pqActiveObjects::instance();
  this->connect(&active, SIGNAL(portChanged(pqOutputPort*)), SLOT(updateSteps()));
  this->connect(&active, SIGNAL(dataUpdated()), SLOT(updateSteps()));
  this->connect(pqApplicationCore::instance(), SIGNAL(forceFilterMenuRefresh()), SLOT(updateSteps()));
  this->updateSteps();
  // Waits until the window has the tool bar, and puts it into a row of its own, as the others are full.
  QTimer::singleShot(0, this, [this] {
    if (auto* window = qobject_cast<QMainWindow*>(pqCoreUtilities::mainWidget()))
    {
      window->insertToolBarBreak(this);
    }
  });
}

void pqAtriaToolBar::addFilter(const QString& text, const QString& name, const QString& tip)
{
  QAction* action = this->addAction(text);
  action->setObjectName(name);
  action->setToolTip(tip);
  action->setProperty("filter", name);
  this->connect(action, &QAction::triggered, [name] { createStep(name); });
}

void pqAtriaToolBar::updateSteps()
{
  pqOutputPort* port = pqActiveObjects::instance().activePort();
  for (QAction* action : this->actions())
  {
    const QString filter = action->property("filter").toString();
    if (!filter.isEmpty())
    {
      action->setEnabled(inputOf(filter, port) != nullptr);
    }
  }
}
