// SPDX-License-Identifier: GPL-3.0-or-later
#include "pqAtriaNameWidget.h"

#include "AtriaModelNames.h"

#include <QComboBox>
#include <QCompleter>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QSignalBlocker>

pqAtriaNameWidget::pqAtriaNameWidget(vtkSMProxy* smproxy, vtkSMProperty* smproperty, QWidget* parent)
    : pqPropertyWidget(smproxy, parent), Names(new QComboBox(this))
{
  this->Names->setObjectName("Names");
  this->Names->setEditable(true);
  this->Names->setInsertPolicy(QComboBox::NoInsert);
  this->Names->completer()->setCaseSensitivity(Qt::CaseSensitive);
  this->Names->lineEdit()->setPlaceholderText(tr("none"));
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(this->Names);
  this->addPropertyLink(this->Names, "currentText", SIGNAL(editTextChanged(const QString&)), smproperty);
}

void pqAtriaNameWidget::showEvent(QShowEvent* event)
{
  this->pqPropertyWidget::showEvent(event);
  const QStringList names = atria::surfaceNamesOf(this->proxy());
  const QSignalBlocker quiet(this->Names);
  const QString text = this->Names->currentText();
  this->Names->clear();
  this->Names->addItems(names);
  this->Names->setEditText(text);
}
