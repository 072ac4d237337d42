/// A signal's sample from a message.
#pragma once

#include <optional>

#include "message.hpp"
#include "zwang/runtime/plant.hpp"

namespace zwang::connect {

PoseFields fields_of(const solver::Pose& pose);
SixFields fields_of(const solver::MotionVector& motion);
SixFields fields_of(const solver::ForceVector& wrench);

/// Force, then moment: in the axes that the sender means [N, N m].
solver::ForceVector wrench_of(const SixFields& fields);

/// nullopt for numbers that cannot be. `arrival` [s] is the stamp of messages without one.
std::optional<runtime::SignalSample> sample_of(const Bool&, const lang::SignalSource&, double arrival);
std::optional<runtime::SignalSample> sample_of(const Float64&, const lang::SignalSource&, double arrival);
std::optional<runtime::SignalSample> sample_of(const LaserScan&, const lang::SignalSource&, double arrival);
std::optional<runtime::SignalSample> sample_of(const PoseStamped&, const lang::SignalSource&, double arrival);
std::optional<runtime::SignalSample> sample_of(const WrenchStamped&, const lang::SignalSource&,
                                               double arrival);

}  // namespace zwang::connect
