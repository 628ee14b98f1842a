// SPDX-License-Identifier: GPL-3.0-or-later
/// A panel widget with a table of rules for surfaces: a row for each rule, then one for each surface of the model that
/// has none.
#pragma once

#include "pqPropertyWidget.h"

#include <QVariant>

class QTableWidget;

/// For a repeatable property of strings, each a rule `PATTERN NUMBER ...`, or a pattern alone. The hint `<RuleTable
/// numbers="Size;At edges"/>` names the numbers of a rule; without it a row is a name to be checked. Rules with more
/// numbers get more columns. Rows keep the order of the rules; rows without numbers are no rules.
class pqAtriaRuleTable : public pqPropertyWidget
{
  Q_OBJECT
  Q_PROPERTY(QList<QVariant> rules READ rules WRITE setRules NOTIFY rulesChanged)

public:
  pqAtriaRuleTable(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);
  ~pqAtriaRuleTable() override = default;

  QList<QVariant> rules() const;
  void setRules(const QList<QVariant>& rules);

Q_SIGNALS:
  void rulesChanged();

protected:
  void showEvent(QShowEvent* event) override;

private Q_SLOTS:
  void addPattern();
  void onEdited();

private:
  Q_DISABLE_COPY(pqAtriaRuleTable)

  bool checksNames() const { return this->Columns.isEmpty(); }
  void addRow(int row, const QString& pattern, const QStringList& numbers, bool isRule);
  void addSurfaces();
  void widen(int numbers);
  QString ruleOf(int row) const;

  QStringList Columns;
  QTableWidget* Table;
};
