#include "zwang/runtime/plant.hpp"

namespace zwang::runtime {

const char* to_string(PlantStatus status) noexcept {
  switch (status) {
    case PlantStatus::ok:
      return "ok";
    case PlantStatus::diverged:
      return "diverged";
    case PlantStatus::unreachable:
      return "unreachable";
  }
  return "unknown";
}

}  // namespace zwang::runtime
