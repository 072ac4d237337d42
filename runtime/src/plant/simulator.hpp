/// MuJoCo as a process-wide library: its handlers, its collision functions, compiling a text, and calls that
/// cannot end the process.
#pragma once

#include <memory>
#include <string>

struct mjModel_;
struct mjData_;

namespace zwang::runtime {

struct ModelDeleter {
  void operator()(mjModel_* model) const;
};
struct DataDeleter {
  void operator()(mjData_* data) const;
};
using ModelPointer = std::unique_ptr<mjModel_, ModelDeleter>;
using DataPointer = std::unique_ptr<mjData_, DataDeleter>;

/// Once, before all else. Replaces the handlers of the whole process; the collision functions act as before
/// outside of `guarded`.
void install_handlers();

/// False when MuJoCo raised an error: the data is void.
bool guarded(void (*call)(const mjModel_*, mjData_*), const mjModel_* model, mjData_* data) noexcept;

/// Throws std::invalid_argument when MuJoCo refuses the text.
ModelPointer compile(const std::string& mjcf);

}  // namespace zwang::runtime
