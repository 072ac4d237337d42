/// MuJoCo as this room uses it: no waiting for keys, no files, no silent resets, and deep contacts.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>

namespace zwang::runtime {

struct ModelDeleter {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct DataDeleter {
  void operator()(mjData* data) const { mj_deleteData(data); }
};

using ModelPointer = std::unique_ptr<mjModel, ModelDeleter>;
using DataPointer = std::unique_ptr<mjData, DataDeleter>;

/// Replaces MuJoCo's process-wide handlers, and its collision of spheres with boxes, by ours. Before all
/// else.
void install_handlers();

/// Compiles MJCF through a virtual file. Throws std::invalid_argument with MuJoCo's words.
ModelPointer compile(const std::string& mjcf);

/// Calls `call`; false when MuJoCo raised an error, and the data is void.
bool guarded(void (*call)(const mjModel*, mjData*), const mjModel* model, mjData* data) noexcept;

}  // namespace zwang::runtime
