// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/RankExchange.h"
#include "Support/RunContext.h"

#include <functional>
#include <optional>
#include <string>

class vtkAlgorithm;
class vtkInformationVector;
class vtkMultiProcessController;

namespace atria {

/// The ranks of a controller.
class ControllerExchange : public RankExchange
{
public:
  explicit ControllerExchange(vtkMultiProcessController& controller) : controller_(controller) {}
  int rank() const override;
  int ranks() const override;
  std::vector<Bytes> exchange(std::vector<Bytes> toRanks) override;
  std::vector<Bytes> gather(const Bytes& own) override;
  bool agreeOn(const std::function<void()>& work) override;

  /// Does what all ranks do together. Where one fails, all others do at their next exchange, at the latest at the end
  /// of the work, and throw what exchange() says. Of all ranks. Work that calls the controller itself does so right
  /// after an exchange, without anything between that can fail.
  void run(const std::function<void()>& work);

private:
  /// What every rank says at the begin of an exchange.
  enum Status : int
  {
    fine,
    failed,
    aborted,
    disagreeing
  };
  /// Sends each rank what is for it, without a copy.
  std::vector<Bytes> pass(const std::function<const Bytes&(int other)>& bytesTo);
  /// What is for which rank, by rank and then by receiver. Throws where a rank is not fine.
  std::vector<long long> ask(Status status, const std::string& message, const std::vector<long long>& sizes);

  vtkMultiProcessController& controller_;
  bool isOver_ = false; ///< as a rank has failed
};

/// Does the work of a filter on all ranks at the same time, and returns as RequestData does: the same on all. What any
/// rank throws is an error of the first one's filter. Returns nothing where the work says so, on all ranks, or where
/// these disagree, with a warning then: the first one is to do it as a whole. Outputs are empty then, as they are after
/// errors. Progress is that of the first rank.
std::optional<int> runOnRanks(vtkAlgorithm& algorithm, vtkInformationVector* outputs,
                              vtkMultiProcessController& controller,
                              const std::function<bool(RankExchange&, const RunContext&)>& work);

} // namespace atria
