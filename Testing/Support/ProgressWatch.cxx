// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/ProgressWatch.h"

#include <vtkAlgorithm.h>
#include <vtkCommand.h>

#include <utility>

namespace atria::testing {

ProgressWatch::ProgressWatch(vtkAlgorithm* target, Condition abortWhen)
    : algorithm(target), condition(std::move(abortWhen))
{
  observer->SetClientData(this);
  observer->SetCallback([](vtkObject*, unsigned long, void* self, void* fraction) {
    static_cast<ProgressWatch*>(self)->note(*static_cast<double*>(fraction));
  });
  tag = algorithm->AddObserver(vtkCommand::ProgressEvent, observer);
}

ProgressWatch::~ProgressWatch()
{
  algorithm->RemoveObserver(tag);
  if (aborted)
  {
    algorithm->AbortExecuteOff(); // pipelines of later versions of VTK leave that to who asked for the abort
  }
}

void ProgressWatch::note(double fraction)
{
  const char* text = algorithm->GetProgressText();
  fractions.push_back(fraction);
  texts.emplace_back(text ? text : "");
  if (condition && condition(fraction, texts.back()))
  {
    aborted = true;
    algorithm->AbortExecuteOn();
  }
}

} // namespace atria::testing
