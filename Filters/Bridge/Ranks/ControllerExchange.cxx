// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/ControllerExchange.h"

#include "AlgorithmProgress.h"
#include "SmpExecutor.h"
#include "Support/Error.h"

#include <vtkAlgorithm.h>
#include <vtkMultiProcessController.h>
#include <vtkMultiProcessStream.h>

#include <algorithm>
#include <new>

namespace atria {

namespace {

constexpr int tag = 27186;
/// MPI counts in 32 bits.
constexpr std::size_t longest = std::size_t{1} << 30;

void send(const Bytes& bytes, int rank, vtkMultiProcessController& controller)
{
  for (std::size_t first = 0; first < bytes.size(); first += longest)
  {
    const auto count = static_cast<vtkIdType>(std::min(longest, bytes.size() - first));
    controller.Send(reinterpret_cast<const unsigned char*>(bytes.data()) + first, count, rank, tag);
  }
}

void receive(Bytes& bytes, int rank, vtkMultiProcessController& controller)
{
  for (std::size_t first = 0; first < bytes.size(); first += longest)
  {
    const auto count = static_cast<vtkIdType>(std::min(longest, bytes.size() - first));
    controller.Receive(reinterpret_cast<unsigned char*>(bytes.data()) + first, count, rank, tag);
  }
}

} // namespace

int ControllerExchange::rank() const { return controller_.GetLocalProcessId(); }
int ControllerExchange::ranks() const { return controller_.GetNumberOfProcesses(); }

std::vector<long long> ControllerExchange::ask(Status status, const std::string& message,
                                               const std::vector<long long>& sizes)
{
  std::vector<long long> own = sizes;
  own.resize(static_cast<std::size_t>(ranks()), 0);
  own.push_back(status);
  std::vector<long long> all(own.size() * static_cast<std::size_t>(ranks()));
  controller_.AllGather(own.data(), all.data(), static_cast<vtkIdType>(own.size()));
  for (int other = 0; other < ranks(); ++other)
  {
    const long long its = all[own.size() * static_cast<std::size_t>(other + 1) - 1];
    if (its == fine)
    {
      continue;
    }
    vtkMultiProcessStream told;
    told << message;
    controller_.Broadcast(told, other);
    std::string text;
    told >> text;
    isOver_ = true;
    if (its == aborted)
    {
      throw Aborted();
    }
    if (its == disagreeing)
    {
      throw RanksDisagree(text);
    }
    throw Error(text);
  }
  return all;
}

std::vector<Bytes> ControllerExchange::exchange(std::vector<Bytes> toRanks)
{
  return pass([&](int other) -> const Bytes& { return toRanks[static_cast<std::size_t>(other)]; });
}

std::vector<Bytes> ControllerExchange::gather(const Bytes& own)
{
  return pass([&](int) -> const Bytes& { return own; });
}

std::vector<Bytes> ControllerExchange::pass(const std::function<const Bytes&(int other)>& bytesTo)
{
  std::vector<long long> sizes(static_cast<std::size_t>(ranks()));
  for (int other = 0; other < ranks(); ++other)
  {
    sizes[static_cast<std::size_t>(other)] = static_cast<long long>(bytesTo(other).size());
  }
  const std::vector<long long> all = ask(fine, {}, sizes);
  std::vector<Bytes> received(sizes.size());
  try
  {
    for (std::size_t other = 0; other < sizes.size(); ++other)
    {
      received[other].resize(
          static_cast<std::size_t>(all[(sizes.size() + 1) * other + static_cast<std::size_t>(rank())]));
    }
  }
  catch (const std::bad_alloc&)
  {
    ask(failed, "a rank has no memory for what others send", {});
  }
  ask(fine, {}, {}); // no rank stops from here on
  std::ranges::copy(bytesTo(rank()), received[static_cast<std::size_t>(rank())].begin());
  // The lower of two ranks sends first, and each rank visits the others in order: no two ranks wait for each other.
  for (int other = 0; other < ranks(); ++other)
  {
    if (other < rank())
    {
      receive(received[static_cast<std::size_t>(other)], other, controller_);
    }
    if (other != rank())
    {
      send(bytesTo(other), other, controller_);
    }
    if (other > rank())
    {
      receive(received[static_cast<std::size_t>(other)], other, controller_);
    }
  }
  return received;
}

void ControllerExchange::run(const std::function<void()>& work)
{
  const auto tell = [&](Status status, const char* message) {
    if (isOver_)
    {
      throw; // another rank has reported it
    }
    ask(status, message, {});
  };
  try
  {
    work();
  }
  catch (const Aborted& stop)
  {
    tell(aborted, stop.what());
  }
  catch (const RanksDisagree& error)
  {
    tell(disagreeing, error.what());
  }
  catch (const std::exception& error)
  {
    tell(failed, error.what());
  }
  catch (...)
  {
    tell(failed, "a rank has failed for a reason that it does not know");
  }
  ask(fine, {}, {});
}

bool ControllerExchange::agreeOn(const std::function<void()>& work)
{
  try
  {
    run(work);
    return true;
  }
  catch (const RanksDisagree&)
  {
    isOver_ = false;
    return false;
  }
}

std::optional<int> runOnRanks(vtkAlgorithm& algorithm, vtkInformationVector* outputs,
                              vtkMultiProcessController& controller,
                              const std::function<bool(RankExchange&, const RunContext&)>& work)
{
  ControllerExchange exchange(controller);
  const bool isRoot = exchange.rank() == 0;
  clearOutputs(outputs);
  try
  {
    const AlgorithmRun run(algorithm);
    SilentMonitor silent;
    const SmpExecutor threads;
    const RunContext context = isRoot ? run.context : RunContext{threads, ProgressRange(silent)};
    bool isDone = false;
    exchange.run([&] { isDone = work(exchange, context); });
    return isDone ? std::optional(1) : std::nullopt;
  }
  catch (const Aborted&)
  {
    clearOutputs(outputs);
    markAborted(outputs);
    return 1;
  }
  catch (const RanksDisagree& error)
  {
    clearOutputs(outputs);
    if (isRoot)
    {
      vtkWarningWithObjectMacro(&algorithm, << error.what() << "; the first one makes the whole");
    }
    return std::nullopt;
  }
  catch (const std::exception& error)
  {
    clearOutputs(outputs);
    if (isRoot)
    {
      vtkErrorWithObjectMacro(&algorithm, << error.what());
    }
    return 0;
  }
}

} // namespace atria
