/// The columns that every log begins with, in their order.
#pragma once

#include <tuple>

#include "log/blank.hpp"
#include "run/shortfall.hpp"

namespace zwang::runtime::log_column {

enum First {
  time,
  task,
  guard,
  solver,
  iterations,
  base_x,
  base_y,
  base_yaw,
  base_vx,
  base_vy,
  base_wz,
  cause,
  cause_exit,
  also_always,
  also_true,
  refusal,
  missed,
  missed_by,
  held_back_by,
  last_held_back_by = held_back_by + 3,
  event,
  event_of,
  event_value,
  estimated_x,
  estimated_y,
  estimated_rz,
  slip,
};

static_assert(std::tuple_size_v<decltype(Shortfall::held_by)> == last_held_back_by - held_back_by + 1);

}  // namespace zwang::runtime::log_column
