// SPDX-License-Identifier: GPL-3.0-or-later
/// Filters, readers and writers where VTK's pipeline works in pieces: ParaView's servers and pvbatch ask each MPI rank
/// for the piece of its number.
///
/// What all ranks hold of the inputs is brought to the first one, the root, which does the work. A mesh among its
/// outputs is dealt out, each rank its piece; of all else the root holds everything, and the others hold empty outputs
/// of the same structure. All succeed, fail or abort as the root does, without messages from the others. So all ranks
/// must run a filter at the same time, as ParaView has them.
///
/// Ranks are those of VTK's global controller, if it has as many as there are pieces. Where it has not, one process is
/// asked for one piece after the other: the first is everything, made of all of the input, the others are empty.
#pragma once

#include "Support/Types.h"

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <functional>
#include <optional>
#include <span>

class vtkAlgorithm;
class vtkDataObject;
class vtkInformation;
class vtkInformationVector;
class vtkMultiProcessController;

namespace atria {

/// Which outputs of an algorithm are a mesh and its patches, to be dealt out to the ranks.
struct DealtOutputs
{
  int mesh = -1;
  int patches = -1;
  /// Divide the mesh anew, in any case; else cells go back to the ranks that have them in the first input, if they came
  /// from several.
  bool anew = false;
};

/// Does the work of a filter on the whole, and returns as RequestData does. The argument has the rank of each cell of
/// the first input, where these came from several.
using WorkOnWhole = std::function<int(std::span<const Index>)>;

/// Does the work of a filter on pieces, if it can.
using WorkOnPieces = std::function<std::optional<int>(vtkMultiProcessController&)>;

/// What there is of something on all ranks in one, on the first rank; null on others. Throws there what is said of
/// joinPieces(), when all has been sent.
vtkSmartPointer<vtkDataObject> gatherWhole(vtkDataObject* own, vtkMultiProcessController& controller);

/// Puts what all ranks have of an output into the first one's; others are left with its structure. Of all ranks.
void moveToRoot(vtkDataObject* output, vtkMultiProcessController& controller);

/// One piece of a number of them, and the ranks that are asked for the others.
class Ranks
{
public:
  Ranks(int piece, int pieces);
  /// Of the pieces last asked for at an output of an algorithm.
  explicit Ranks(vtkInformation* info);

  bool isRoot() const { return piece == 0; }
  /// Whether there are others.
  explicit operator bool() const { return controller != nullptr; }
  /// That of the ranks; null without others.
  vtkMultiProcessController* getController() const { return controller; }

  /// Has the inputs asked for what `run` needs.
  void askFor(vtkInformationVector** inputs, int ports) const;

  /// Puts what there is of the inputs on all ranks in place of the root's inputs while `work` runs there, and returns
  /// what `work` did, on all ranks. Then deals out what is `dealt`, with as many
  /// ghost levels as it is asked for, but one at least; on the others all else becomes empty. Inputs that cannot be
  /// brought together are an error of `algorithm`.
  ///
  /// `onPieces`, if given, is run first, on all ranks and with what each of them holds: where it returns a result, the
  /// same on all, this is it.
  int run(vtkAlgorithm& algorithm, vtkInformationVector** inputs, vtkInformationVector* outputs,
          const WorkOnWhole& work, const DealtOutputs& dealt = {}, const WorkOnPieces& onPieces = {}) const;

  /// The same outside of a request, with the inputs that the algorithm has now and no outputs.
  int run(vtkAlgorithm& algorithm, const std::function<int()>& work) const;

  /// Makes the root's values those of all.
  void share(std::span<double> values) const;

private:
  int piece = 0;
  int pieces = 1;
  vtkMultiProcessController* controller = nullptr; ///< of several ranks, else null
};

/// What ProcessRequest is to do on any number of ranks. `process` does what it does on one.
vtkTypeBool processOnRanks(vtkAlgorithm& algorithm, vtkInformation* request, vtkInformationVector** inputs,
                           vtkInformationVector* outputs, const std::function<vtkTypeBool()>& process,
                           const DealtOutputs& dealt = {}, const WorkOnPieces& onPieces = {});

} // namespace atria
