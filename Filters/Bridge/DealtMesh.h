// SPDX-License-Identifier: GPL-3.0-or-later
/// A mesh that the first rank holds, dealt out to all.
#pragma once

#include "Ranks.h"
#include "Support/Types.h"

#include <vector>

namespace atria {

/// How many ghost levels any rank asks for, but one at least; of all ranks.
int ghostLevelsAsked(vtkInformationVector* outputs, vtkMultiProcessController& controller);

/// Deals out the outputs of an algorithm that has done its work on the first rank; the others' are empty. `rankOf`, on
/// the first rank, has the rank of each cell, if that is known. The first rank makes one piece after the other, so that
/// it holds the whole and one piece at most. Returns what RequestData does: 0, on all ranks, where the first one cannot
/// make a piece, with an error there and empty outputs everywhere.
int dealMesh(vtkAlgorithm& algorithm, vtkInformationVector* outputs, const DealtOutputs& dealt,
             std::vector<Index> rankOf, vtkMultiProcessController& controller);

} // namespace atria
