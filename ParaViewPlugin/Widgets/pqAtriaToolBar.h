// SPDX-License-Identifier: GPL-3.0-or-later
/// The tool bar that leads from a model to a case in five steps.
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

  /// Adds an action that puts the filter behind the selection or, if it does not accept that, behind the nearest
  /// upstream port that it accepts.
  void addFilter(const QString& text, const QString& name, const QString& tip);
};
