// SPDX-License-Identifier: GPL-3.0-or-later
/// Octree, 2:1 balance and partition among MPI ranks: p4est on all of them, and ours on the first, which deals out the
/// leaves. Prints a row of a table.
///
/// Usage: mpiexec -n RANKS benchmark_p4est_ranks DEPTH [REPEATS]
/// The refinement is that of SphereOctants.h; every rank looks octants up in the whole of it, outside of what is timed.
/// Times are the clock's, between barriers, the least of the repeats.
#include "Octree/Tree/Balance.h"
#include "SphereOctants.h"

#include <p8est_bits.h>
#include <p8est_extended.h>

#include <mpi.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace {

using namespace atria;

int rank()
{
  int own = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &own);
  return own;
}

int ranks()
{
  int count = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  return count;
}

int shouldRefine(p8est_t* forest, p4est_topidx_t, p8est_quadrant_t* octant)
{
  const auto& sets = *static_cast<const RefinedSets*>(forest->user_pointer);
  const auto level = static_cast<std::size_t>(octant->level);
  if (level >= sets.size())
  {
    return 0;
  }
  const int shift = P8EST_MAXLEVEL - octant->level;
  const MortonKey key =
      mortonKey({static_cast<std::uint32_t>(octant->x >> shift), static_cast<std::uint32_t>(octant->y >> shift),
                 static_cast<std::uint32_t>(octant->z >> shift)});
  return std::ranges::binary_search(sets[level], key) ? 1 : 0;
}

/// What a phase takes, from when all ranks begin to when all have ended.
double secondsOf(const std::function<void()>& phase)
{
  MPI_Barrier(MPI_COMM_WORLD);
  const double start = MPI_Wtime();
  phase();
  MPI_Barrier(MPI_COMM_WORLD);
  return MPI_Wtime() - start;
}

struct Measured
{
  std::array<double, 3> seconds{}; ///< refine, balance, partition
  std::int64_t leaves = 0;         ///< of all ranks
  std::int64_t most = 0;           ///< of one
};

void count(std::int64_t own, Measured& measured)
{
  MPI_Allreduce(&own, &measured.leaves, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
  MPI_Allreduce(&own, &measured.most, 1, MPI_INT64_T, MPI_MAX, MPI_COMM_WORLD);
}

/// Refined level by level, with the octants divided anew after each, so that all ranks have work.
Measured withP4est(p8est_connectivity_t* cube, RefinedSets& sets)
{
  Measured measured;
  p8est_t* forest = p8est_new_ext(MPI_COMM_WORLD, cube, 0, 0, 1, 0, nullptr, &sets);
  for (std::size_t level = 0; level < sets.size(); ++level)
  {
    measured.seconds[0] += secondsOf([&] { p8est_refine(forest, 0, shouldRefine, nullptr); });
    measured.seconds[2] += secondsOf([&] { p8est_partition(forest, 0, nullptr); });
  }
  measured.seconds[1] = secondsOf([&] { p8est_balance(forest, P8EST_CONNECT_FULL, nullptr); });
  measured.seconds[2] += secondsOf([&] { p8est_partition(forest, 0, nullptr); });
  count(forest->local_num_quadrants, measured);
  p8est_destroy(forest);
  return measured;
}

/// Sends each rank its range of the first one's list.
template <typename T> std::vector<T> dealt(const std::vector<T>& all, std::vector<int> counts, MPI_Datatype type)
{
  std::vector<int> first(counts.size(), 0);
  std::partial_sum(counts.begin(), counts.end() - 1, first.begin() + 1);
  std::vector<T> own(static_cast<std::size_t>(counts[static_cast<std::size_t>(rank())]));
  MPI_Scatterv(all.data(), counts.data(), first.data(), type, own.data(), static_cast<int>(own.size()), type, 0,
               MPI_COMM_WORLD);
  return own;
}

/// Key and level of a rank's leaves. Leaves are in Morton order, so a share is a range.
std::int64_t dealOut(const std::vector<MortonKey>& keys, const std::vector<std::uint8_t>& levels)
{
  std::int64_t leaves = static_cast<std::int64_t>(keys.size());
  MPI_Bcast(&leaves, 1, MPI_INT64_T, 0, MPI_COMM_WORLD);
  std::vector<int> counts(static_cast<std::size_t>(ranks()));
  for (std::size_t i = 0; i < counts.size(); ++i)
  {
    const auto parts = static_cast<std::int64_t>(counts.size());
    const auto part = static_cast<std::int64_t>(i);
    counts[i] = static_cast<int>(leaves * (part + 1) / parts - leaves * part / parts);
  }
  dealt(levels, counts, MPI_UINT8_T);
  return static_cast<std::int64_t>(dealt(keys, counts, MPI_UINT64_T).size());
}

Measured withOurs(const GridFrame& frame, const RefinedSets& given)
{
  const SerialExecutor executor;
  SilentMonitor silent;
  Measured measured;
  std::vector<MortonKey> keys;
  std::vector<std::uint8_t> levels;
  RefinedSets sets = given;
  measured.seconds[1] = secondsOf([&] {
    if (rank() == 0)
    {
      balance(sets, frame, {executor, ProgressRange(silent)});
    }
  });
  measured.seconds[0] = secondsOf([&] {
    const Octree octree = rank() == 0 ? Octree(frame, sets) : Octree();
    keys.resize(octree.leafCount());
    levels.resize(octree.leafCount());
    for (Index leaf = 0; leaf < keys.size(); ++leaf)
    {
      keys[leaf] = octree.key(leaf);
      levels[leaf] = static_cast<std::uint8_t>(octree.level(leaf));
    }
  });
  std::int64_t own = 0;
  measured.seconds[2] = secondsOf([&] { own = dealOut(keys, levels); });
  count(own, measured);
  return measured;
}

void print(const char* name, int depth, int repeats, const std::function<Measured()>& measure)
{
  Measured least;
  least.seconds.fill(std::numeric_limits<double>::max());
  for (int i = 0; i < repeats; ++i)
  {
    const Measured now = measure();
    least.leaves = now.leaves;
    least.most = now.most;
    std::ranges::transform(least.seconds, now.seconds, least.seconds.begin(),
                           [](double a, double b) { return std::min(a, b); });
  }
  if (rank() == 0)
  {
    std::printf("| %s | %d | %d | %lld | %.3f | %.3f | %.3f | %.3f |\n", name, ranks(), depth,
                static_cast<long long>(least.leaves), least.seconds[0], least.seconds[1], least.seconds[2],
                static_cast<double>(least.most) * ranks() / static_cast<double>(least.leaves));
  }
}

} // namespace

int main(int argc, char* argv[])
{
  MPI_Init(&argc, &argv);
  sc_init(MPI_COMM_WORLD, 0, 0, nullptr, SC_LP_SILENT);
  p4est_init(nullptr, SC_LP_SILENT);
  const int depth = argc > 1 ? std::atoi(argv[1]) : 8;
  const int repeats = argc > 2 ? std::atoi(argv[2]) : 3;
  RefinedSets sets = measuring::sphereOctants(depth);
  const GridFrame frame = measuring::sphereFrame(depth);
  p8est_connectivity_t* cube = p8est_connectivity_new_unitcube();
  print("p4est", depth, repeats, [&] { return withP4est(cube, sets); });
  print("Atria, on the first", depth, repeats, [&] { return withOurs(frame, sets); });
  p8est_connectivity_destroy(cube);
  sc_finalize();
  MPI_Finalize();
  return 0;
}
