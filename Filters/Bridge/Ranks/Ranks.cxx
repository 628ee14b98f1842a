// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/Ranks.h"

#include "AlgorithmProgress.h"
#include "Ranks/DealtMesh.h"
#include "Ranks/Transport.h"
#include "Ranks/VtkPieces.h"

#include <vtkAlgorithm.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataObject.h>
#include <vtkDemandDrivenPipeline.h>
#include <vtkExecutive.h>
#include <vtkInformation.h>
#include <vtkInformationIntegerKey.h>
#include <vtkInformationVector.h>
#include <vtkMultiProcessController.h>
#include <vtkMultiProcessStream.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <exception>
#include <string>
#include <utility>
#include <vector>

namespace atria {

namespace {

using Pipeline = vtkStreamingDemandDrivenPipeline;

constexpr int root = 0;
/// Key of an output: 1 if the pipeline runs the filter for each block of a composite input. The number of blocks may
/// differ between ranks, so each rank works on its own then.
vtkInformationIntegerKey* runsByBlock()
{
  static vtkInformationIntegerKey* const key = vtkInformationIntegerKey::MakeKey("RUNS_BY_BLOCK", "Atria");
  return key;
}

bool takesComposite(vtkAlgorithm& algorithm, int port)
{
  vtkInformation* info = algorithm.GetInputPortInformation(port);
  for (int i = 0; i < info->Length(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE()); ++i)
  {
    const std::string type = info->Get(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), i);
    if (type == "vtkDataObject" || type == "vtkCompositeDataSet" || type == "vtkPartitionedDataSetCollection")
    {
      return true;
    }
  }
  return false;
}

bool isRunByBlock(vtkAlgorithm& algorithm, vtkInformationVector** inputs)
{
  for (int port = 0; port < algorithm.GetNumberOfInputPorts(); ++port)
  {
    if (vtkCompositeDataSet::GetData(inputs[port]) && !takesComposite(algorithm, port))
    {
      return true;
    }
  }
  return false;
}

/// The non-empty pieces of all ranks, on the root; empty on others.
struct Pieces
{
  std::vector<vtkSmartPointer<vtkDataObject>> data;
  std::vector<Index> ranks;
};

Pieces gather(vtkDataObject* own, vtkMultiProcessController& controller)
{
  const bool isRoot = controller.GetLocalProcessId() == root;
  const int holds = own && !isEmptyPiece(own) ? 1 : 0;
  std::vector<int> held(static_cast<std::size_t>(controller.GetNumberOfProcesses()));
  controller.AllGather(&holds, held.data(), 1);
  Pieces pieces;
  if (!isRoot && holds)
  {
    sendData(withoutGhosts(own), root, controller);
  }
  for (int rank = 0; isRoot && rank < controller.GetNumberOfProcesses(); ++rank)
  {
    if (held[static_cast<std::size_t>(rank)])
    {
      pieces.data.push_back(rank == root ? withoutGhosts(own) : receiveData(rank, controller));
      pieces.ranks.push_back(static_cast<Index>(rank));
    }
  }
  return pieces;
}

/// Joins the pieces and frees them. `rankOf`, if given, becomes the rank of each cell if these came from several.
vtkSmartPointer<vtkDataObject> joinFound(Pieces& found, std::vector<Index>* rankOf)
{
  const bool wasDivided = found.data.size() > 1;
  const std::vector<vtkSmartPointer<vtkDataObject>> pieces = std::exchange(found.data, {});
  vtkSmartPointer<vtkDataObject> whole = joinPieces(pieces, wasDivided ? rankOf : nullptr);
  if (rankOf)
  {
    std::ranges::transform(*rankOf, rankOf->begin(), [&](Index piece) { return found.ranks[piece]; });
  }
  return whole;
}

/// Replaces inputs by others during its lifetime.
class InputsInPlace
{
public:
  InputsInPlace() = default;
  InputsInPlace(const InputsInPlace&) = delete;
  InputsInPlace& operator=(const InputsInPlace&) = delete;
  ~InputsInPlace()
  {
    for (const auto& [info, data] : replaced)
    {
      put(data, info);
    }
  }

  void replace(vtkInformation* info, vtkDataObject* data)
  {
    replaced.emplace_back(info, vtkDataObject::GetData(info));
    put(data, info);
  }

private:
  static void put(vtkDataObject* data, vtkInformation* info) { info->Set(vtkDataObject::DATA_OBJECT(), data); }

  std::vector<std::pair<vtkInformation*, vtkSmartPointer<vtkDataObject>>> replaced;
};

template <typename F> void forInputs(vtkAlgorithm& algorithm, vtkInformationVector** inputs, F&& body)
{
  for (int port = 0; port < algorithm.GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < inputs[port]->GetNumberOfInformationObjects(); ++i)
    {
      body(inputs[port]->GetInformationObject(i));
    }
  }
}

void putInOnePiece(vtkInformation* info, InputsInPlace& places)
{
  vtkDataObject* data = vtkDataObject::GetData(info);
  const vtkSmartPointer<vtkDataObject> whole = data ? inOnePiece(data) : nullptr;
  if (whole != data)
  {
    places.replace(info, whole);
  }
}

void writeStructure(vtkDataObject* output, vtkMultiProcessStream& stream)
{
  auto* sets = vtkPartitionedDataSetCollection::SafeDownCast(output);
  const unsigned int count = sets ? sets->GetNumberOfPartitionedDataSets() : 0;
  stream << count;
  for (unsigned int i = 0; i < count; ++i)
  {
    const char* name = sets->HasMetaData(i) ? sets->GetMetaData(i)->Get(vtkCompositeDataSet::NAME()) : nullptr;
    stream << std::string(name ? name : "");
  }
}

void makeEmpty(vtkDataObject* output, vtkMultiProcessStream& structure)
{
  output->Initialize();
  unsigned int count = 0;
  structure >> count;
  auto* sets = vtkPartitionedDataSetCollection::SafeDownCast(output);
  if (sets)
  {
    sets->SetNumberOfPartitionedDataSets(count);
  }
  for (unsigned int i = 0; i < count; ++i)
  {
    std::string name;
    structure >> name;
    sets->SetNumberOfPartitions(i, 0);
    sets->GetMetaData(i)->Set(vtkCompositeDataSet::NAME(), name.c_str());
  }
}

/// Announces a ghost level to the pipeline, so that a filter that requests one later does not run everything again.
void askForGhosts(vtkInformationVector* outputs)
{
  for (int i = 0; i < outputs->GetNumberOfInformationObjects(); ++i)
  {
    vtkInformation* info = outputs->GetInformationObject(i);
    auto* key = Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS();
    info->Set(key, std::max(1, info->Has(key) ? info->Get(key) : 0));
  }
}

bool wasAborted(vtkInformationVector* outputs)
{
  vtkInformation* first = outputs->GetInformationObject(0);
  return first && first->Get(vtkDemandDrivenPipeline::DATA_NOT_GENERATED()) == 1;
}

/// Sends the root's result and the structure of its outputs to the others. Returns the result on all ranks.
int shareResult(int result, vtkInformationVector* outputs, vtkMultiProcessController& controller)
{
  const int count = outputs->GetNumberOfInformationObjects();
  const bool isRoot = controller.GetLocalProcessId() == root;
  vtkMultiProcessStream told;
  if (isRoot)
  {
    told << result << (wasAborted(outputs) ? 1 : 0);
    for (int i = 0; i < count; ++i)
    {
      writeStructure(vtkDataObject::GetData(outputs, i), told);
    }
  }
  controller.Broadcast(told, root);
  if (!isRoot)
  {
    int aborted = 0;
    told >> result >> aborted;
    for (int i = 0; i < count; ++i)
    {
      makeEmpty(vtkDataObject::GetData(outputs, i), told);
    }
    if (aborted)
    {
      markAborted(outputs);
    }
  }
  return result;
}

} // namespace

vtkSmartPointer<vtkDataObject> gatherWhole(vtkDataObject* own, vtkMultiProcessController& controller)
{
  Pieces found = gather(own, controller);
  return found.data.empty() ? nullptr : joinFound(found, nullptr);
}

void moveToRoot(vtkDataObject* output, vtkMultiProcessController& controller)
{
  const vtkSmartPointer<vtkDataObject> whole = gatherWhole(output, controller);
  auto* sets = vtkPartitionedDataSetCollection::SafeDownCast(output);
  if (whole)
  {
    output->ShallowCopy(whole);
  }
  else if (!sets)
  {
    output->Initialize();
  }
  for (unsigned int i = 0; sets && !whole && i < sets->GetNumberOfPartitionedDataSets(); ++i)
  {
    sets->SetNumberOfPartitions(i, 0);
  }
}

Ranks::Ranks(int piece_, int pieces_) : piece(piece_), pieces(pieces_)
{
  auto* global = vtkMultiProcessController::GetGlobalController();
  if (pieces > 1 && global && global->GetNumberOfProcesses() == pieces && global->GetLocalProcessId() == piece)
  {
    controller = global;
  }
}

Ranks::Ranks(vtkInformation* info)
    : Ranks(info && info->Has(Pipeline::UPDATE_PIECE_NUMBER()) ? info->Get(Pipeline::UPDATE_PIECE_NUMBER()) : 0,
            info && info->Has(Pipeline::UPDATE_NUMBER_OF_PIECES()) ? info->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()) : 1)
{
}

void Ranks::askFor(vtkInformationVector** inputs, int ports) const
{
  for (int port = 0; port < ports; ++port)
  {
    for (int i = 0; i < inputs[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkInformation* info = inputs[port]->GetInformationObject(i);
      info->Set(Pipeline::UPDATE_PIECE_NUMBER(), controller ? piece : 0);
      info->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), controller ? pieces : 1);
      info->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    }
  }
}

int Ranks::run(vtkAlgorithm& algorithm, vtkInformationVector** inputs, vtkInformationVector* outputs,
               const WorkOnWhole& work, const DealtOutputs& dealt, const WorkOnPieces& onPieces) const
{
  if (!controller)
  {
    if (isRoot())
    {
      InputsInPlace whole;
      forInputs(algorithm, inputs, [&](vtkInformation* info) { putInOnePiece(info, whole); });
      return work({});
    }
    for (int i = 0; i < outputs->GetNumberOfInformationObjects(); ++i)
    {
      vtkDataObject::GetData(outputs, i)->Initialize();
    }
    return 1;
  }
  if (const std::optional<int> done = onPieces ? onPieces(*controller) : std::nullopt)
  {
    return *done;
  }
  std::vector<std::pair<vtkInformation*, Pieces>> gathered;
  forInputs(algorithm, inputs, [&](vtkInformation* info) {
    gathered.emplace_back(info, gather(vtkDataObject::GetData(info), *controller));
  });
  int result = 0;
  std::vector<Index> rankOf; // one entry per cell of the first input
  try
  {
    InputsInPlace whole;
    for (auto& [info, found] : gathered)
    {
      if (!found.data.empty())
      {
        whole.replace(info, joinFound(found, &found == &gathered.front().second ? &rankOf : nullptr));
      }
    }
    result = isRoot() ? work(rankOf) : 0;
  }
  catch (const std::exception& error)
  {
    vtkErrorWithObjectMacro(&algorithm, << error.what());
  }
  result = shareResult(result, outputs, *controller);
  return result == 1 && dealt.mesh >= 0 ? dealMesh(algorithm, outputs, dealt, std::move(rankOf), *controller) : result;
}

int Ranks::run(vtkAlgorithm& algorithm, const std::function<int()>& work) const
{
  return run(algorithm, algorithm.GetExecutive()->GetInputInformation(), vtkNew<vtkInformationVector>(),
             [&](std::span<const Index>) { return work(); });
}

void Ranks::share(std::span<double> values) const
{
  if (controller)
  {
    controller->Broadcast(values.data(), static_cast<vtkIdType>(values.size()), root);
  }
}

vtkTypeBool processOnRanks(vtkAlgorithm& algorithm, vtkInformation* request, vtkInformationVector** inputs,
                           vtkInformationVector* outputs, const std::function<vtkTypeBool()>& process,
                           const DealtOutputs& dealt, const WorkOnPieces& onPieces)
{
  const int asked = request->Has(vtkExecutive::FROM_OUTPUT_PORT()) ? request->Get(vtkExecutive::FROM_OUTPUT_PORT()) : 0;
  vtkInformation* output = outputs->GetInformationObject(asked > 0 ? asked : 0);
  if (request->Has(Pipeline::REQUEST_DATA()))
  {
    const auto work = [&](std::span<const Index>) { return process(); };
    return output->Get(runsByBlock()) ? process()
                                      : Ranks(output).run(algorithm, inputs, outputs, work, dealt, onPieces);
  }
  const vtkTypeBool result = process();
  if (request->Has(Pipeline::REQUEST_INFORMATION()))
  {
    for (int i = 0; i < outputs->GetNumberOfInformationObjects(); ++i)
    {
      outputs->GetInformationObject(i)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
    }
  }
  // This is the pipeline's own request; requests of its loop over blocks come after forwarding.
  if (request->Has(Pipeline::REQUEST_UPDATE_EXTENT()) && request->Has(vtkExecutive::ALGORITHM_BEFORE_FORWARD()))
  {
    output->Set(runsByBlock(), isRunByBlock(algorithm, inputs) ? 1 : 0);
    const Ranks ranks(output);
    ranks.askFor(inputs, algorithm.GetNumberOfInputPorts());
    if (ranks && dealt.mesh >= 0)
    {
      askForGhosts(outputs);
    }
  }
  return result;
}

} // namespace atria
