// SPDX-License-Identifier: GPL-3.0-or-later
/// A panel widget for the name of a surface: chosen from those of the model, or typed, as patterns are.
#pragma once

#include "pqPropertyWidget.h"

class QComboBox;

/// For a property of one string.
class pqAtriaNameWidget : public pqPropertyWidget
{
  Q_OBJECT

public:
  pqAtriaNameWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);
  ~pqAtriaNameWidget() override = default;

protected:
  void showEvent(QShowEvent* event) override;

private:
  Q_DISABLE_COPY(pqAtriaNameWidget)

  QComboBox* Names;
};
