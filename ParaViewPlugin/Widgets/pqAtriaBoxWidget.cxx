// SPDX-License-Identifier: GPL-3.0-or-later
#include "pqAtriaBoxWidget.h"

#include "AtriaModelNames.h"

#include <pqActiveObjects.h>
#include <pqCoreUtilities.h>
#include <pqDoubleLineEdit.h>
#include <pqPipelineSource.h>
#include <vtkCommand.h>
#include <vtkMath.h>
#include <vtkSMNewWidgetRepresentationProxy.h>
#include <vtkSMPropertyGroup.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMUncheckedPropertyHelper.h>
#include <vtkSMVectorProperty.h>

#include <QCheckBox>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>

#include <array>
#include <cmath>

namespace {

using Point = std::array<double, 3>;

/// Returns the lower corner of a box by its middle, along axes turned by `degrees`; or back with negative lengths.
Point lowerCorner(const Point& middle, const Point& lengths, double degrees)
{
  const double c = std::cos(vtkMath::RadiansFromDegrees(degrees));
  const double s = std::sin(vtkMath::RadiansFromDegrees(degrees));
  const double x = 0.5 * lengths[0];
  const double y = 0.5 * lengths[1];
  return {middle[0] - c * x + s * y, middle[1] - s * x - c * y, middle[2] - 0.5 * lengths[2]};
}

} // namespace

pqAtriaBoxWidget::pqAtriaBoxWidget(vtkSMProxy* smproxy, vtkSMPropertyGroup* group, QWidget* parent)
    : pqInteractivePropertyWidget("representations", "BoxWidgetRepresentation", smproxy, group, parent),
      Bounds(group->GetProperty("Bounds"))
{
  Q_ASSERT(this->Bounds);
  vtkSMProxy* box = this->widgetProxy();
  vtkSMPropertyHelper(box, "UseReferenceBounds").Set(0);
  vtkSMPropertyHelper(box, "RotationEnabled").Set(0);
  box->UpdateVTKObjects();
  this->addNumbers();
  this->connect(this, SIGNAL(interaction()), SLOT(boundsFromView()));
  this->connect(this, SIGNAL(endInteraction()), SLOT(boundsFromView()));
  pqCoreUtilities::connect(this->Bounds, vtkCommand::UncheckedPropertyModifiedEvent, this, SLOT(viewFromBounds()));
  if (vtkSMProperty* turn = smproxy->GetProperty("DomainAngle"))
  {
    pqCoreUtilities::connect(turn, vtkCommand::UncheckedPropertyModifiedEvent, this, SLOT(viewFromBounds()));
  }
  this->viewFromBounds();
}

void pqAtriaBoxWidget::addNumbers()
{
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  auto* shown = new QCheckBox(tr("Show Box"), this);
  shown->setObjectName("show3DWidget");
  shown->setToolTip(tr("Shows the box in the view, where its faces and corners can be drawn."));
  shown->setChecked(true);
  this->connect(shown, SIGNAL(toggled(bool)), SLOT(setWidgetVisible(bool)));
  shown->connect(this, SIGNAL(widgetVisibilityToggled(bool)), SLOT(setChecked(bool)));
  this->setWidgetVisible(true);
  grid->addWidget(shown, 0, 0, 1, 2);
  auto* fit = new QPushButton(tr("Fit to Model"), this);
  fit->setObjectName("fitToModel");
  fit->setToolTip(tr("Makes the box the bounds of the model."));
  this->connect(fit, SIGNAL(clicked()), SLOT(fitToModel()));
  grid->addWidget(fit, 0, 2);
  grid->addWidget(new QLabel(tr("from"), this), 1, 1);
  grid->addWidget(new QLabel(tr("to"), this), 1, 2);
  const int count = static_cast<int>(vtkSMPropertyHelper(this->Bounds).GetNumberOfElements());
  for (int i = 0; i < count; ++i)
  {
    static const char* const names[4] = {"x", "y", "z", "Size"};
    const int row = 2 + i / 2;
    if (i % 2 == 0)
    {
      grid->addWidget(new QLabel(names[i / 2], this), row, 0);
    }
    auto* edit = new pqDoubleLineEdit(this);
    edit->setObjectName(QString("bound%1").arg(i));
    edit->setToolTip(pqPropertyWidget::getTooltip(this->Bounds));
    this->addPropertyLink(edit, "text2", SIGNAL(textChangedAndEditingFinished()), this->Bounds, i);
    grid->addWidget(edit, row, 1 + i % 2);
  }
}

double pqAtriaBoxWidget::angle() const
{
  vtkSMProperty* turn = this->proxy()->GetProperty("DomainAngle");
  return turn ? vtkSMUncheckedPropertyHelper(turn).GetAsDouble() : 0.0;
}

void pqAtriaBoxWidget::placeWidget()
{
  // Position and scale refer to the box of length one at the origin.
  const double unit[6] = {0, 1, 0, 1, 0, 1};
  vtkSMPropertyHelper(this->widgetProxy(), "PlaceWidget").Set(unit, 6);
  this->widgetProxy()->UpdateVTKObjects();
  this->viewFromBounds();
}

void pqAtriaBoxWidget::viewFromBounds()
{
  if (this->Updating)
  {
    return;
  }
  double b[6];
  vtkSMUncheckedPropertyHelper bounds(this->Bounds);
  for (unsigned int i = 0; i < 6; ++i)
  {
    b[i] = bounds.GetAsDouble(i);
  }
  const Point lengths = {b[1] - b[0], b[3] - b[2], b[5] - b[4]};
  const Point middle = {0.5 * (b[0] + b[1]), 0.5 * (b[2] + b[3]), 0.5 * (b[4] + b[5])};
  const Point corner = lowerCorner(middle, lengths, this->angle());
  const double rotation[3] = {0.0, 0.0, this->angle()};
  vtkSMProxy* box = this->widgetProxy();
  vtkSMPropertyHelper(box, "Position").Set(corner.data(), 3);
  vtkSMPropertyHelper(box, "Rotation").Set(rotation, 3);
  vtkSMPropertyHelper(box, "Scale").Set(lengths.data(), 3);
  box->UpdateVTKObjects();
  this->render();
}

void pqAtriaBoxWidget::boundsFromView()
{
  Point corner;
  Point lengths;
  vtkSMPropertyHelper(this->widgetProxy(), "Position").Get(corner.data(), 3);
  vtkSMPropertyHelper(this->widgetProxy(), "Scale").Get(lengths.data(), 3);
  const Point middle = lowerCorner(corner, {-lengths[0], -lengths[1], -lengths[2]}, this->angle());
  this->Updating = true;
  vtkSMUncheckedPropertyHelper bounds(this->Bounds);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double half = 0.5 * std::abs(lengths[axis]);
    bounds.Set(2 * axis, middle[axis] - half);
    bounds.Set(2 * axis + 1, middle[axis] + half);
  }
  this->Updating = false;
}

void pqAtriaBoxWidget::fitToModel()
{
  vtkBoundingBox model;
  if (this->proxy()->GetProperty("Input"))
  {
    model = atria::modelBoundsOf(this->proxy());
  }
  else if (pqPipelineSource* filter = pqActiveObjects::instance().activeSource())
  {
    model = atria::modelBoundsOf(filter->getProxy()); // the box is one of a list of the filter
  }
  if (model.IsValid())
  {
    double b[6];
    model.GetBounds(b);
    vtkSMUncheckedPropertyHelper bounds(this->Bounds);
    for (unsigned int i = 0; i < 6; ++i)
    {
      bounds.Set(i, b[i]);
    }
    Q_EMIT this->changeAvailable();
    Q_EMIT this->changeFinished();
  }
}
