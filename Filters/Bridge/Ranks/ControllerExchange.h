// SPDX-License-Identifier: GPL-3.0-or-later
/// Exchange of the core over a vtkMultiProcessController, and the run of a filter on all its ranks.
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

/// Exchange between the ranks of a controller.
class ControllerExchange : public RankExchange
{
public:
  explicit ControllerExchange(vtkMultiProcessController& controller) : controller_(controller) {}
  int rank() const override;
  int ranks() const override;
  std::vector<Bytes> exchange(std::vector<Bytes> toRanks) override;
  std::vector<Bytes> gather(const Bytes& own) override;
  bool agreeOn(const std::function<void()>& work) override;

  /// Runs `work` on all ranks together; all must call it. If one fails, all others fail at their next exchange, at the
  /// latest at the end of the work, with the exception that exchange() names. Work that calls the controller itself
  /// must do so right after an exchange, with nothing in between that can fail.
  void run(const std::function<void()>& work);

private:
  /// State that every rank reports at the start of an exchange.
  enum Status : int
  {
    fine,
    failed,
    aborted,
    disagreeing
  };
  /// Sends each rank its bytes, without a copy.
  std::vector<Bytes> pass(const std::function<const Bytes&(int other)>& bytesTo);
  /// Gathers status and sizes of all ranks: for each sender, one size per receiver and then its status. Throws if a
  /// rank is not fine.
  std::vector<long long> ask(Status status, const std::string& message, const std::vector<long long>& sizes);

  vtkMultiProcessController& controller_;
  bool isOver_ = false; ///< true once a rank has failed
};

/// Runs the work of a filter on all ranks at the same time and returns the result of RequestData, the same on all. An
/// exception on any rank is an error of the first rank's filter. Returns nullopt on all ranks if `work` returns false,
/// or, with a warning, if the ranks disagree: the first rank must then do the whole work. Outputs are empty then, as
/// after errors. Progress is that of the first rank.
std::optional<int> runOnRanks(vtkAlgorithm& algorithm, vtkInformationVector* outputs,
                              vtkMultiProcessController& controller,
                              const std::function<bool(RankExchange&, const RunContext&)>& work);

} // namespace atria
