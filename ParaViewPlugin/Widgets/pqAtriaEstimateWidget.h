// SPDX-License-Identifier: GPL-3.0-or-later
/// A panel widget that estimates the number of elements before the values in the panel are applied.
#pragma once

#include "pqPropertyWidget.h"

class QLabel;

/// For a property without values of a proxy that takes those of the octree source.
class pqAtriaEstimateWidget : public pqPropertyWidget
{
  Q_OBJECT

public:
  pqAtriaEstimateWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);
  ~pqAtriaEstimateWidget() override = default;

private Q_SLOTS:
  void estimate();

private:
  Q_DISABLE_COPY(pqAtriaEstimateWidget)

  QLabel* Result;
};
