// SPDX-License-Identifier: GPL-3.0-or-later
/// Octree and 2:1 balance across faces, edges and corners against p4est, on the same refinement, on one core.
///
/// Both are given which octants to refine: p4est by a function that looks them up, in the order in which it asks.
#include "Octree/Tree/Balance.h"
#include "SphereOctants.h"

#include <p8est_bits.h>
#include <p8est_extended.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

namespace {

using namespace atria;

/// Octants are asked for in Morton order, on each level.
struct Lookup
{
  const RefinedSets* sets;
  std::vector<std::size_t> next;
};

int shouldRefine(p8est_t* forest, p4est_topidx_t, p8est_quadrant_t* octant)
{
  auto& lookup = *static_cast<Lookup*>(forest->user_pointer);
  const auto level = static_cast<std::size_t>(octant->level);
  if (level >= lookup.sets->size())
  {
    return 0;
  }
  const int shift = P8EST_MAXLEVEL - octant->level;
  const MortonKey key =
      mortonKey({static_cast<std::uint32_t>(octant->x >> shift), static_cast<std::uint32_t>(octant->y >> shift),
                 static_cast<std::uint32_t>(octant->z >> shift)});
  const std::vector<MortonKey>& keys = (*lookup.sets)[level];
  std::size_t& i = lookup.next[level];
  while (i < keys.size() && keys[i] < key)
  {
    ++i;
  }
  return i < keys.size() && keys[i] == key ? 1 : 0;
}

std::size_t leavesOfP4est(p8est_connectivity_t* cube, const RefinedSets& sets)
{
  Lookup lookup{&sets, std::vector<std::size_t>(sets.size(), 0)};
  p8est_t* forest = p8est_new_ext(sc_MPI_COMM_WORLD, cube, 0, 0, 1, 0, nullptr, &lookup);
  p8est_refine(forest, 1, shouldRefine, nullptr);
  p8est_balance(forest, P8EST_CONNECT_FULL, nullptr);
  const auto leaves = static_cast<std::size_t>(forest->local_num_quadrants);
  p8est_destroy(forest);
  return leaves;
}

std::size_t leavesOfAtria(const GridFrame& frame, const RefinedSets& given)
{
  const SerialExecutor executor;
  SilentMonitor silent;
  RefinedSets sets = given;
  balance(sets, frame, {executor, ProgressRange(silent)});
  return Octree(frame, sets).leafCount();
}

void p4est(benchmark::State& state)
{
  const RefinedSets sets = atria::measuring::sphereOctants(static_cast<int>(state.range(0)));
  p8est_connectivity_t* cube = p8est_connectivity_new_unitcube();
  std::size_t leaves = 0;
  for (auto _ : state)
  {
    leaves = leavesOfP4est(cube, sets);
  }
  p8est_connectivity_destroy(cube);
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * leaves));
  state.counters["leaves"] = static_cast<double>(leaves);
}

void ours(benchmark::State& state)
{
  const int depth = static_cast<int>(state.range(0));
  const RefinedSets sets = atria::measuring::sphereOctants(depth);
  const GridFrame frame = atria::measuring::sphereFrame(depth);
  std::size_t leaves = 0;
  for (auto _ : state)
  {
    leaves = leavesOfAtria(frame, sets);
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * leaves));
  state.counters["leaves"] = static_cast<double>(leaves);
}

} // namespace

int main(int argc, char* argv[])
{
  sc_MPI_Init(&argc, &argv);
  sc_init(sc_MPI_COMM_WORLD, 0, 0, nullptr, SC_LP_SILENT);
  p4est_init(nullptr, SC_LP_SILENT);
  for (const int depth : {8, 9, 10})
  {
    benchmark::RegisterBenchmark("p4est", p4est)->Arg(depth)->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark("Atria", ours)->Arg(depth)->Unit(benchmark::kMillisecond);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  sc_finalize();
  sc_MPI_Finalize();
  return 0;
}
