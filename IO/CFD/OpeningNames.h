// SPDX-License-Identifier: GPL-3.0-or-later
/// Recognizes openings of ventilation by what patches are called.
#pragma once

#include <optional>
#include <string_view>

namespace atria {

enum class VentilationOpening
{
  Inlet, ///< air is blown in
  Outlet ///< air leaves
};

/// Returns what a patch of this name is, or nullopt for names of anything else.
///
/// A name is divided into words at punctuation, at digits and before capitals: `Inlet_1`, `northSupply`, `EXHAUST-2`.
/// Capitals and a plural's s do not matter.
/// - Words of inlets are inlet, inflow, supply and diffuser.
/// - Words of outlets are outlet, outflow, exhaust, extract and return.
/// - A name with words of both kinds is neither. The same holds for names that also speak of something solid or
///   electric, such as `SupplyDuct`, `Outlet_frame`, `PowerOutlet`.
std::optional<VentilationOpening> ventilationOpeningOf(std::string_view patchName);

} // namespace atria
