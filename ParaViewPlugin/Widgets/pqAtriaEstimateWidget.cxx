// SPDX-License-Identifier: GPL-3.0-or-later
#include "pqAtriaEstimateWidget.h"

#include <vtkSMPropertyHelper.h>
#include <vtkSMPropertyIterator.h>
#include <vtkSMProxyProperty.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMSourceProxy.h>
#include <vtkSMUncheckedPropertyHelper.h>
#include <vtkSMVectorProperty.h>
#include <vtkSmartPointer.h>

#include <QApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QPushButton>

namespace {

/// Gives `to` the values that the panel shows of `from`, applied or not.
void copyShown(vtkSMProxy* from, vtkSMProxy* to)
{
  vtkSmartPointer<vtkSMPropertyIterator> it;
  it.TakeReference(from->NewPropertyIterator());
  for (it->Begin(); !it->IsAtEnd(); it->Next())
  {
    vtkSMProperty* source = it->GetProperty();
    vtkSMProperty* target = to->GetProperty(it->GetKey());
    if (!target || source->GetInformationOnly())
    {
      continue;
    }
    if (vtkSMProxyProperty::SafeDownCast(source))
    {
      target->Copy(source);
    }
    else if (vtkSMVectorProperty::SafeDownCast(source))
    {
      vtkSMUncheckedPropertyHelper shown(source);
      vtkSMPropertyHelper(target).Copy(shown);
    }
  }
  to->UpdateVTKObjects();
}

QString resultOf(vtkSMProxy* octree)
{
  const auto elements = vtkSMPropertyHelper(octree, "EstimatedElements").GetAsIdType();
  const auto bytes = vtkSMPropertyHelper(octree, "EstimatedBytes").GetAsIdType();
  if (elements == 0)
  {
    return QObject::tr("cannot be told, see the messages");
  }
  const QLocale locale(QLocale::English);
  return QObject::tr("%1%2 elements and those of layers, %3 GB%4")
      .arg(vtkSMPropertyHelper(octree, "EstimateIsTooLarge").GetAsInt() ? QObject::tr("at least ") : QString())
      .arg(locale.toString(static_cast<qlonglong>(elements)))
      .arg(locale.toString(1e-9 * static_cast<double>(bytes), 'g', 2))
      .arg(vtkSMPropertyHelper(octree, "EstimateIsTooLarge").GetAsInt() ? QObject::tr(": too much for this machine")
                                                                        : QString());
}

} // namespace

pqAtriaEstimateWidget::pqAtriaEstimateWidget(vtkSMProxy* smproxy, vtkSMProperty* smproperty, QWidget* parent)
    : pqPropertyWidget(smproxy, parent), Result(new QLabel(this))
{
  this->setShowLabel(false);
  auto* button = new QPushButton(tr("Estimate"), this);
  button->setObjectName("Estimate");
  button->setToolTip(pqPropertyWidget::getTooltip(smproperty));
  this->connect(button, SIGNAL(clicked()), SLOT(estimate()));
  this->Result->setObjectName("Result");
  this->Result->setWordWrap(true);
  this->Result->setText(tr("elements to expect, before Apply"));
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(button);
  layout->addWidget(this->Result, 1);
}

void pqAtriaEstimateWidget::estimate()
{
  vtkSmartPointer<vtkSMProxy> octree;
  octree.TakeReference(this->proxy()->GetSessionProxyManager()->NewProxy("filters", "AtriaOctreeSource"));
  QApplication::setOverrideCursor(Qt::WaitCursor);
  copyShown(this->proxy(), octree);
  octree->InvokeCommand("Estimate");
  octree->UpdatePropertyInformation();
  QApplication::restoreOverrideCursor();
  this->Result->setText(resultOf(octree));
}
