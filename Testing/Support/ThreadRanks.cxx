// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/ThreadRanks.h"

#include "Support/Error.h"

#include <algorithm>
#include <barrier>
#include <exception>
#include <thread>
#include <utility>
#include <vector>

namespace atria::testing {

namespace {

struct Mailboxes
{
  explicit Mailboxes(int ranks)
      : barrier(ranks), boxes(static_cast<std::size_t>(ranks)), failures(static_cast<std::size_t>(ranks))
  {
  }

  std::barrier<> barrier;
  std::vector<std::vector<Bytes>> boxes;    ///< by sender, then by receiver
  std::vector<std::exception_ptr> failures; ///< by rank
};

class ThreadRank : public RankExchange
{
public:
  ThreadRank(Mailboxes& mailboxes, int number) : mail(mailboxes), own(number) {}
  int rank() const override { return own; }
  int ranks() const override { return static_cast<int>(mail.boxes.size()); }

  std::vector<Bytes> exchange(std::vector<Bytes> toRanks) override
  {
    mail.boxes[static_cast<std::size_t>(own)] = std::move(toRanks);
    expectNoFailure(nullptr);
    std::vector<Bytes> received;
    for (std::vector<Bytes>& box : mail.boxes)
    {
      received.push_back(std::move(box[static_cast<std::size_t>(own)]));
    }
    mail.barrier.arrive_and_wait();
    return received;
  }

  bool agreeOn(const std::function<void()>& work) override
  {
    try
    {
      run(work);
      return true;
    }
    catch (const RanksDisagree&)
    {
      isOver = false;
      return false;
    }
  }

  /// Throws on all ranks what the first of those that throw does.
  void run(const std::function<void()>& work)
  {
    std::exception_ptr failure;
    try
    {
      work();
    }
    catch (...)
    {
      if (isOver)
      {
        throw; // all have heard of it
      }
      failure = std::current_exception();
    }
    expectNoFailure(failure);
  }

private:
  void expectNoFailure(const std::exception_ptr& ownFailure)
  {
    mail.failures[static_cast<std::size_t>(own)] = ownFailure;
    mail.barrier.arrive_and_wait();
    const auto found = std::ranges::find_if(mail.failures, [](const auto& failure) { return failure != nullptr; });
    const std::exception_ptr first = found == mail.failures.end() ? nullptr : *found;
    mail.barrier.arrive_and_wait();
    if (first)
    {
      isOver = true;
      std::rethrow_exception(first);
    }
  }

  Mailboxes& mail;
  int own;
  bool isOver = false; ///< as a rank has failed
};

} // namespace

void onRanks(int ranks, const std::function<void(RankExchange&)>& work)
{
  Mailboxes mail(ranks);
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(ranks));
  std::vector<std::thread> threads;
  threads.reserve(failures.size());
  for (int rank = 0; rank < ranks; ++rank)
  {
    threads.emplace_back([&, rank] {
      ThreadRank own(mail, rank);
      try
      {
        own.run([&] { work(own); });
      }
      catch (...)
      {
        failures[static_cast<std::size_t>(rank)] = std::current_exception();
      }
    });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  if (failures.front()) // all have the same
  {
    std::rethrow_exception(failures.front());
  }
}

} // namespace atria::testing
