// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs filters, readers and writers on all ranks of a parallel pipeline: ParaView's servers and pvbatch request from
/// each MPI rank the piece of its number.
///
/// The inputs of all ranks are gathered on the first one, the root, which does the work. A mesh among its outputs is
/// distributed, each rank gets its piece. The root holds all other outputs; the others hold empty outputs of the same
/// structure. All ranks succeed, fail or abort as the root does, without messages from the others. All ranks must
/// therefore run a filter at the same time, as they do in ParaView.
///
/// Ranks are those of VTK's global controller, if it has as many as there are pieces. If not, one process is asked for
/// one piece after the other: the first is everything, made from all of the input, the others are empty.
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

/// Output ports with a mesh and its patches that are distributed to the ranks; -1 for none.
struct DealtOutputs
{
  int mesh = -1;
  int patches = -1;
  /// True: always divide the mesh anew. False: cells return to the ranks that have them in the first input, if they
  /// came from several.
  bool anew = false;
};

/// Does the work of a filter on the whole data and returns the result of RequestData. The argument has the rank of each
/// cell of the first input, if these came from several ranks.
using WorkOnWhole = std::function<int(std::span<const Index>)>;

/// Does the work of a filter on pieces, if it can.
using WorkOnPieces = std::function<std::optional<int>(vtkMultiProcessController&)>;

/// Joins the pieces of all ranks on the first rank; returns null on others. Throws on the first rank as joinPieces()
/// does, after everything has been sent.
vtkSmartPointer<vtkDataObject> gatherWhole(vtkDataObject* own, vtkMultiProcessController& controller);

/// Joins the pieces of an output on the first rank; the others keep only its structure. All ranks must call it.
void moveToRoot(vtkDataObject* output, vtkMultiProcessController& controller);

/// One of several pieces, and the ranks that are asked for the others.
class Ranks
{
public:
  Ranks(int piece, int pieces);
  /// Takes the piece last requested at an output of an algorithm.
  explicit Ranks(vtkInformation* info);

  bool isRoot() const { return piece == 0; }
  /// True if there are other ranks.
  explicit operator bool() const { return controller != nullptr; }
  /// Returns the controller of the ranks; null without others.
  vtkMultiProcessController* getController() const { return controller; }

  /// Requests from the inputs the data that `run` needs.
  void askFor(vtkInformationVector** inputs, int ports) const;

  /// Replaces the root's inputs by those of all ranks, joined, while `work` runs there, and returns the result of
  /// `work` on all ranks. Then distributes the outputs in `dealt`, with the requested number of ghost levels, at least
  /// one; all other outputs of other ranks become empty. Inputs that cannot be joined are an error of `algorithm`.
  ///
  /// `onPieces`, if given, runs first, on all ranks and with the data of each. If it returns a result, the same on all,
  /// this is the result.
  int run(vtkAlgorithm& algorithm, vtkInformationVector** inputs, vtkInformationVector* outputs,
          const WorkOnWhole& work, const DealtOutputs& dealt = {}, const WorkOnPieces& onPieces = {}) const;

  /// The same outside of a request, with the algorithm's current inputs and no outputs.
  int run(vtkAlgorithm& algorithm, const std::function<int()>& work) const;

  /// Copies the root's values to all ranks.
  void share(std::span<double> values) const;

private:
  int piece = 0;
  int pieces = 1;
  vtkMultiProcessController* controller = nullptr; ///< null unless there are several ranks
};

/// Does the work of ProcessRequest on any number of ranks. `process` does it on one rank.
vtkTypeBool processOnRanks(vtkAlgorithm& algorithm, vtkInformation* request, vtkInformationVector** inputs,
                           vtkInformationVector* outputs, const std::function<vtkTypeBool()>& process,
                           const DealtOutputs& dealt = {}, const WorkOnPieces& onPieces = {});

} // namespace atria
