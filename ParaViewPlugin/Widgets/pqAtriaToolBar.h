// SPDX-License-Identifier: GPL-3.0-or-later
/// From a model to a case in five steps.
#pragma once

#include <QToolBar>

class pqAtriaToolBar : public QToolBar
{
  Q_OBJECT

public:
  explicit pqAtriaToolBar(QWidget* parent = nullptr);
  ~pqAtriaToolBar() override = default;

private Q_SLOTS:
  void updateSteps();

private:
  Q_DISABLE_COPY(pqAtriaToolBar)

  /// An action that puts the filter behind what is selected, or where it does not take that, behind the nearest
  /// upstream that it takes.
  void addFilter(const QString& text, const QString& name, const QString& tip);
};
