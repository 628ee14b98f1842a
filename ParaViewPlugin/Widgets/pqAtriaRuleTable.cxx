// SPDX-License-Identifier: GPL-3.0-or-later
#include "pqAtriaRuleTable.h"

#include "AtriaModelNames.h"

#include <vtkPVXMLElement.h>
#include <vtkSMProperty.h>

#include <QHBoxLayout>
#include <QHeaderView>
#include <QPushButton>
#include <QRegularExpression>
#include <QSet>
#include <QSignalBlocker>
#include <QTableWidget>
#include <QVBoxLayout>

#include <algorithm>

namespace {

constexpr int shownRows = 8;

/// Returns the pattern, without its quotes, and the words behind it.
std::pair<QString, QStringList> partsOf(const QString& rule)
{
  static const QRegularExpression quoted(QStringLiteral("^\\s*\"([^\"]*)\"(.*)$"));
  const QRegularExpressionMatch match = quoted.match(rule);
  QStringList words =
      (match.hasMatch() ? match.captured(2) : rule).split(QRegularExpression("\\s+"), Qt::SkipEmptyParts);
  if (match.hasMatch())
  {
    return {match.captured(1), words};
  }
  return words.isEmpty() ? std::pair<QString, QStringList>() : std::pair{words.takeFirst(), words};
}

QString quotedIfNeeded(const QString& pattern)
{
  return pattern.contains(QRegularExpression("\\s")) ? '"' + pattern + '"' : pattern;
}

} // namespace

pqAtriaRuleTable::pqAtriaRuleTable(vtkSMProxy* smproxy, vtkSMProperty* smproperty, QWidget* parent)
    : pqPropertyWidget(smproxy, parent), Table(new QTableWidget(this))
{
  this->setShowLabel(false);
  vtkPVXMLElement* hints = smproperty->GetHints();
  if (vtkPVXMLElement* hint = hints ? hints->FindNestedElementByName("RuleTable") : nullptr)
  {
    this->Columns = QString(hint->GetAttributeOrEmpty("numbers")).split(';', Qt::SkipEmptyParts);
  }
  this->Table->setObjectName("Rules");
  this->Table->setToolTip(pqPropertyWidget::getTooltip(smproperty));
  this->Table->verticalHeader()->hide();
  this->Table->setWordWrap(false);
  this->Table->setSelectionMode(QAbstractItemView::SingleSelection);
  this->Table->setFixedHeight((shownRows + 1) * this->Table->verticalHeader()->defaultSectionSize());
  this->widen(this->Columns.size());
  auto* add = new QPushButton(tr("Add Pattern"), this);
  add->setObjectName("AddPattern");
  add->setToolTip(tr("Adds a row for all surfaces whose names match, such as Wall*."));
  this->connect(add, SIGNAL(clicked()), SLOT(addPattern()));
  auto* buttons = new QHBoxLayout;
  buttons->addWidget(add);
  buttons->addStretch();
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(this->Table);
  layout->addLayout(buttons);
  this->connect(this->Table, SIGNAL(itemChanged(QTableWidgetItem*)), SLOT(onEdited()));
  this->addPropertyLink(this, "rules", SIGNAL(rulesChanged()), smproperty);
}

void pqAtriaRuleTable::widen(int numbers)
{
  const int given = this->Columns.size();
  QStringList labels(tr("Surface"));
  for (int i = 0; i < std::max(numbers, given); ++i)
  {
    const QString repeat = i < given ? QString() : QString(" %1").arg(i / given + 1);
    labels << this->Columns[i % given] + repeat;
  }
  if (labels.size() > this->Table->columnCount())
  {
    this->Table->setColumnCount(labels.size());
    this->Table->setHorizontalHeaderLabels(labels);
    QHeaderView* header = this->Table->horizontalHeader();
    header->setSectionResizeMode(QHeaderView::ResizeToContents);
    header->setSectionResizeMode(0, QHeaderView::Stretch);
  }
}

void pqAtriaRuleTable::addRow(int row, const QString& pattern, const QStringList& numbers, bool isRule)
{
  this->widen(this->checksNames() ? 0 : numbers.size());
  this->Table->insertRow(row);
  auto* name = new QTableWidgetItem(pattern);
  name->setData(Qt::UserRole, isRule);
  if (this->checksNames())
  {
    name->setCheckState(isRule ? Qt::Checked : Qt::Unchecked);
  }
  this->Table->setItem(row, 0, name);
  for (int column = 1; column < this->Table->columnCount(); ++column)
  {
    this->Table->setItem(row, column, new QTableWidgetItem(numbers.value(column - 1)));
  }
}

void pqAtriaRuleTable::setRules(const QList<QVariant>& rules)
{
  if (rules == this->rules())
  {
    return;
  }
  const QSignalBlocker quiet(this->Table);
  this->Table->setRowCount(0);
  for (const QVariant& rule : rules)
  {
    if (this->checksNames())
    {
      this->addRow(this->Table->rowCount(), rule.toString(), {}, true);
    }
    else
    {
      const auto [pattern, numbers] = partsOf(rule.toString());
      this->addRow(this->Table->rowCount(), pattern, numbers, true);
    }
  }
  this->addSurfaces();
}

void pqAtriaRuleTable::addSurfaces()
{
  QSet<QString> present;
  for (int row = 0; row < this->Table->rowCount(); ++row)
  {
    present.insert(this->Table->item(row, 0)->text());
  }
  for (const QString& name : atria::surfaceNamesOf(this->proxy()))
  {
    if (!present.contains(name))
    {
      this->addRow(this->Table->rowCount(), name, {}, false);
    }
  }
}

QString pqAtriaRuleTable::ruleOf(int row) const
{
  const QTableWidgetItem* name = this->Table->item(row, 0);
  if (this->checksNames())
  {
    return name->checkState() == Qt::Checked ? name->text().trimmed() : QString();
  }
  QStringList words;
  for (int column = 1; column < this->Table->columnCount(); ++column)
  {
    const QTableWidgetItem* item = this->Table->item(row, column);
    const QString word = item ? item->text().trimmed() : QString();
    if (word.isEmpty())
    {
      break;
    }
    words << word;
  }
  return words.isEmpty() ? QString() : quotedIfNeeded(name->text().trimmed()) + ' ' + words.join(' ');
}

QList<QVariant> pqAtriaRuleTable::rules() const
{
  QList<QVariant> rules;
  for (int row = 0; row < this->Table->rowCount(); ++row)
  {
    if (const QString rule = this->ruleOf(row); !rule.isEmpty())
    {
      rules << rule;
    }
  }
  return rules;
}

void pqAtriaRuleTable::addPattern()
{
  {
    const QSignalBlocker quiet(this->Table);
    this->addRow(0, "*", {}, false);
  }
  this->Table->scrollToTop();
  this->Table->editItem(this->Table->item(0, 0));
}

void pqAtriaRuleTable::onEdited() { Q_EMIT this->rulesChanged(); }

void pqAtriaRuleTable::showEvent(QShowEvent* event)
{
  this->pqPropertyWidget::showEvent(event);
  const QSignalBlocker quiet(this->Table);
  this->addSurfaces();
}
