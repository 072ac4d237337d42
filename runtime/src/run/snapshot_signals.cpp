#include "run/snapshot_signals.hpp"

#include <algorithm>

namespace zwang::runtime {

SnapshotSignals::SnapshotSignals(const lang::Program& program) {
  for (const lang::Signal& signal : program.signals) {
    const bool has_frame = signal.type == lang::SignalType::pose || signal.type == lang::SignalType::wrench;
    places_.push_back(own_.size());
    own_.push_back({signal.name,
                    has_frame ? program.frames[static_cast<std::size_t>(signal.in)].name : std::string(),
                    signal.type});
  }
  measured_ = own_;
}

const SnapshotSignals::Signal* SnapshotSignals::find(const std::vector<Signal>& signals,
                                                     const std::string& name) noexcept {
  const auto found = std::find_if(signals.begin(), signals.end(),
                                  [&name](const Signal& signal) { return signal.name == name; });
  return found == signals.end() ? nullptr : &*found;
}

SwapResult SnapshotSignals::match(const SnapshotSignals& before) const noexcept {
  for (const Signal& own : own_) {
    const Signal* measured = find(before.measured_, own.name);
    if (measured == nullptr) return {SwapRefusal::signal_missing, own.name.c_str()};
    if (measured->type != own.type) return {SwapRefusal::signal_type, own.name.c_str()};
    if (measured->frame != own.frame) return {SwapRefusal::signal_frame, own.name.c_str()};
  }
  return {};
}

void SnapshotSignals::go_on_from(SnapshotSignals& before) noexcept {
  measured_.swap(before.measured_);
  for (std::size_t i = 0; i < own_.size(); ++i)
    places_[i] = static_cast<std::size_t>(find(measured_, own_[i].name) - measured_.data());
}

}  // namespace zwang::runtime
