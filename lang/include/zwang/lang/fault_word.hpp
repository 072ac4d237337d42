/// The faults that scene and scenario files name by a word.
#pragma once

#include <array>

#include "zwang/lang/scene.hpp"

namespace zwang::lang {

/// `samples: lost`
struct FaultWord {
  const char* key;
  const char* word;
  FaultKind kind;
};
inline constexpr std::array fault_words{
    FaultWord{"samples", "lost", FaultKind::samples_lost},
    FaultWord{"samples", "nan", FaultKind::samples_nan},
    FaultWord{"samples", "inf", FaultKind::samples_inf},
    FaultWord{"samples", "huge", FaultKind::samples_huge},
    FaultWord{"samples", "frozen", FaultKind::samples_frozen},
    FaultWord{"samples", "dead", FaultKind::samples_dead},
    FaultWord{"clock", "backwards", FaultKind::clock_backwards},
    FaultWord{"clock", "ahead", FaultKind::clock_ahead},
    FaultWord{"torque", "lost", FaultKind::torque_lost},
    FaultWord{"torque", "stuck", FaultKind::torque_stuck},
    FaultWord{"torque", "flipped", FaultKind::torque_flipped},
    FaultWord{"plant", "diverges", FaultKind::plant_diverges},
};

/// The largest shares of the base link's mass and of its inertia that a fault may take away.
inline constexpr double most_payload_less = 0.75, most_inertia_less = 0.75;

}  // namespace zwang::lang
