/// Reports samples of a signal, or poses of the base, that come and cannot be taken.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "zwang/lang/program.hpp"
#include "zwang/runtime/event.hpp"
#include "zwang/runtime/odometry.hpp"
#include "zwang/runtime/plant.hpp"

namespace zwang::runtime {

/// Reports samples that are stamped ahead of the snapshot, or so long before it that the clock must be
/// another one. It also reports samples with a non-finite number or an invalid rotation. Without a report
/// such a signal would look like one that never came. Does not allocate, lock, throw or print after
/// construction.
class SignalWatch {
 public:
  explicit SignalWatch(const lang::Program& program);

  /// Every good sample: as it came, and with the program's signals out of it. `expected`: how many signals
  /// the snapshot should have. Each signal is told once. The event's value: by how much its stamp is ahead
  /// [s]; 0 where it is not the stamp. Of a snapshot of another size, once: no signal, and its size.
  std::optional<Event> look(const Sensed& sensed, std::size_t expected, const Sensed& sample) noexcept;

  static constexpr double ahead = 0.1;    ///< [s] a stamp of the next few ticks is only early
  static constexpr double behind = 60.0;  ///< [s]
  /// [s] of a pose of the base: older ones are not remembered that it could be compared with.
  static constexpr double fix_behind = OdometrySettings{}.memory;

 private:
  struct Watched {
    lang::SignalType type = lang::SignalType::boolean;
    double stamp = std::numeric_limits<double>::quiet_NaN();  ///< [s] of the last sample
    bool is_told = false;
  };
  std::optional<Event> look_at_fix(const Sensed& sensed) noexcept;

  std::vector<Watched> signals_;
  Watched fix_{.type = lang::SignalType::pose};
  int joints_;
  bool size_is_told_ = false;
};

}  // namespace zwang::runtime
