// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/ThreadRanks.h"

#include "Support/Error.h"

#include <atomic>
#include <barrier>
#include <exception>
#include <thread>
#include <utility>
#include <vector>

namespace atria::testing {

namespace {

class Mailboxes
{
public:
  explicit Mailboxes(int ranks) : barrier(ranks), boxes(static_cast<std::size_t>(ranks)) {}

  std::barrier<> barrier;
  std::vector<std::vector<Bytes>> boxes; ///< by sender, then by receiver
  std::atomic<bool> failed = false;
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
    mail.barrier.arrive_and_wait();
    if (mail.failed)
    {
      throw Error("another rank failed");
    }
    std::vector<Bytes> received;
    for (std::vector<Bytes>& box : mail.boxes)
    {
      received.push_back(std::move(box[static_cast<std::size_t>(own)]));
    }
    mail.barrier.arrive_and_wait();
    return received;
  }

private:
  Mailboxes& mail;
  int own;
};

} // namespace

void onRanks(int ranks, const std::function<void(RankExchange&)>& work)
{
  Mailboxes mail(ranks);
  std::exception_ptr first;
  std::vector<std::thread> threads;
  for (int rank = 0; rank < ranks; ++rank)
  {
    threads.emplace_back([&, rank] {
      ThreadRank own(mail, rank);
      try
      {
        work(own);
      }
      catch (...)
      {
        if (!mail.failed.exchange(true))
        {
          first = std::current_exception();
        }
        mail.barrier.arrive_and_drop();
      }
    });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  if (first)
  {
    std::rethrow_exception(first);
  }
}

} // namespace atria::testing
