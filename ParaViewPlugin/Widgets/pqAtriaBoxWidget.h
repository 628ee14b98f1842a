// SPDX-License-Identifier: GPL-3.0-or-later
/// A panel widget for a box of six bounds, by numbers and by a box in the view. A seventh number is the size of
/// elements in it.
#pragma once

#include "pqInteractivePropertyWidget.h"

/// For a property group with one property, of six or seven doubles, whose function is `Bounds`. If the proxy has a
/// property DomainAngle, the box in the view is turned by it around its middle.
class pqAtriaBoxWidget : public pqInteractivePropertyWidget
{
  Q_OBJECT

public:
  pqAtriaBoxWidget(vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parent = nullptr);
  ~pqAtriaBoxWidget() override = default;

protected Q_SLOTS:
  void placeWidget() override;

private Q_SLOTS:
  void boundsFromView();
  void viewFromBounds();
  void fitToModel();

private:
  Q_DISABLE_COPY(pqAtriaBoxWidget)

  void addNumbers();
  double angle() const;

  vtkSMProperty* Bounds = nullptr;
  bool Updating = false;
};
