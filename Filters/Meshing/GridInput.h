// SPDX-License-Identifier: GPL-3.0-or-later
/// What the filters of a model's grid have in common: from properties and input data to the core's structures.
#pragma once

#include "Mesher/ModelOptions.h"
#include "Support/RankExchange.h"

#include <functional>
#include <span>

class vtkAtriaGridAlgorithm;
class vtkDataObject;
class vtkMultiProcessController;

namespace atria {

/// The properties of the filter, and what surfaces the data say is ground. Sizes of 0 are to be completed. Throws Error
/// for rules that are none.
ModelOptions modelOptionsOf(vtkAtriaGridAlgorithm& filter, vtkDataObject* surfaces);

/// The same, with sizes that follow from the model in place of those that are 0; see completeSizes in
/// Mesher/SuggestedSizes.h.
ModelOptions modelOptionsOf(vtkAtriaGridAlgorithm& filter, vtkDataObject* surfaces, const TriangleSurface& surface);

/// Runs `work` on the data of input port 0, up to date, or null without a connection: on the rank that has it all, see
/// Ranks.h. What `work` throws is an error of the filter. Returns whether it was done, and gives all ranks `values` as
/// `work` left them.
bool onCurrentInput(vtkAtriaGridAlgorithm& filter, std::span<double> values,
                    const std::function<void(vtkDataObject*)>& work);

/// `data` may be null: a domain without surfaces. Adds what a user should know of it.
TriangleSurface readSurfaces(vtkDataObject* data, std::vector<std::string>& warnings);

struct SharedSurfaces
{
  TriangleSurface surface;
  /// Names of surfaces that are ground.
  std::vector<std::string> grounds;
  /// What a reader subtracted from its points, model units.
  Vec3 offset;
  /// What a user should know of it, on the first rank.
  std::vector<std::string> warnings;
};

/// The surfaces that ranks have together, on all of them, which call it at the same time, right after an exchange.
/// Throws as readSurfaces().
SharedSurfaces readSurfacesOnRanks(vtkDataObject* own, vtkMultiProcessController& controller, RankExchange& exchange);

/// What a reader subtracted from the model's points, so that writers can add it again; zero where nothing is said.
Vec3 modelOffsetOf(vtkDataObject* surfaces);

void addTo(std::vector<std::string>& warnings, const std::vector<std::string>& more);

/// Adds the field array SizingWarning, with one text or none, and warns.
void addSizingWarning(const std::string& warning, vtkAtriaGridAlgorithm& filter, vtkDataObject* out);

/// Adds the field array InputWarning, and warns of each.
void addInputWarnings(const std::vector<std::string>& warnings, vtkAtriaGridAlgorithm& filter, vtkDataObject* out);

/// Adds the field array InputNote.
void addInputNotes(const std::vector<std::string>& notes, vtkDataObject* out);

} // namespace atria
