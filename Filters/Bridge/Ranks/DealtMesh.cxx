// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/DealtMesh.h"

#include "Ranks/Transport.h"
#include "Ranks/VtkShares.h"
#include "SmpExecutor.h"

#include <vtkAlgorithm.h>
#include <vtkCommunicator.h>
#include <vtkDataObject.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiProcessController.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <exception>
#include <utility>

namespace atria {

namespace {

constexpr int root = 0;

constexpr int tag = 27184;

/// The distributed outputs of one rank.
class Hand
{
public:
  Hand(vtkInformationVector* all, const DealtOutputs& dealt)
      : mesh(vtkUnstructuredGrid::GetData(all, dealt.mesh)),
        patches(dealt.patches >= 0 ? vtkPartitionedDataSetCollection::GetData(all, dealt.patches) : nullptr)
  {
  }

  void clear() const
  {
    mesh->Initialize();
    if (patches)
    {
      patches->Initialize();
    }
  }

  void take(vtkDataObject* ofMesh, vtkDataObject* ofPatches) const
  {
    mesh->ShallowCopy(ofMesh);
    if (patches)
    {
      patches->ShallowCopy(ofPatches);
    }
  }

  vtkUnstructuredGrid* mesh;
  vtkPartitionedDataSetCollection* patches;
};

/// Sends a flag that says if a piece follows, then the piece.
void sendPiece(bool comes, vtkDataObject* mesh, vtkDataObject* patches, int rank, vtkMultiProcessController& controller)
{
  const int notice = comes ? 1 : 0;
  controller.Send(&notice, 1, rank, tag);
  if (comes)
  {
    sendData(mesh, rank, controller);
    sendData(patches, rank, controller);
  }
}

void receivePiece(const Hand& hand, vtkMultiProcessController& controller)
{
  int comes = 0;
  controller.Receive(&comes, 1, root, tag);
  if (comes)
  {
    const auto mesh = receiveData(root, controller);
    hand.take(mesh, receiveData(root, controller));
  }
}

/// Sends the other ranks their pieces and keeps the root's. Returns true if all could be made.
bool deal(vtkAlgorithm& algorithm, const Hand& hand, std::vector<Index> rankOf, int levels,
          vtkMultiProcessController& controller)
{
  const int ranks = controller.GetNumberOfProcesses();
  int next = root + 1;
  try
  {
    if (rankOf.empty())
    {
      rankOf = divideCells(hand.mesh, static_cast<std::size_t>(ranks), SmpExecutor());
    }
    MeshShares shares(hand.mesh, std::move(rankOf), static_cast<std::size_t>(ranks), levels);
    const auto patchesOf = [&](int rank) {
      return hand.patches ? shares.patches(hand.patches, static_cast<std::size_t>(rank)) : nullptr;
    };
    for (; next < ranks; ++next)
    {
      const auto mesh = shares.mesh(static_cast<std::size_t>(next));
      sendPiece(true, mesh, patchesOf(next), next, controller);
    }
    const auto mesh = shares.mesh(root);
    hand.take(mesh, patchesOf(root));
    return true;
  }
  catch (const std::exception& error)
  {
    vtkErrorWithObjectMacro(&algorithm, "Cannot deal out the mesh to the ranks: " << error.what());
  }
  for (; next < ranks; ++next)
  {
    sendPiece(false, nullptr, nullptr, next, controller);
  }
  return false;
}

} // namespace

int ghostLevelsAsked(vtkInformationVector* outputs, vtkMultiProcessController& controller)
{
  int own = 1;
  for (int i = 0; i < outputs->GetNumberOfInformationObjects(); ++i)
  {
    vtkInformation* info = outputs->GetInformationObject(i);
    auto* key = vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS();
    own = std::max(own, info->Has(key) ? info->Get(key) : 0);
  }
  int levels = own;
  controller.AllReduce(&own, &levels, 1, vtkCommunicator::MAX_OP);
  return levels;
}

int dealMesh(vtkAlgorithm& algorithm, vtkInformationVector* outputs, const DealtOutputs& dealt,
             std::vector<Index> rankOf, vtkMultiProcessController& controller)
{
  const Hand hand(outputs, dealt);
  const bool isRoot = controller.GetLocalProcessId() == root;
  const int levels = ghostLevelsAsked(outputs, controller);
  const bool isKnown = !rankOf.empty() && static_cast<vtkIdType>(rankOf.size()) == hand.mesh->GetNumberOfCells();
  int goes = hand.mesh->GetNumberOfCells() > 0 && (dealt.anew || isKnown) ? 1 : 0;
  controller.Broadcast(&goes, 1, root);
  if (!goes)
  {
    return 1;
  }
  int done = 0;
  if (isRoot)
  {
    done = deal(algorithm, hand, dealt.anew ? std::vector<Index>() : std::move(rankOf), levels, controller) ? 1 : 0;
  }
  else
  {
    receivePiece(hand, controller);
  }
  controller.Broadcast(&done, 1, root);
  if (!done)
  {
    hand.clear();
  }
  return done;
}

} // namespace atria
