// The only file of the benchmarks that knows MuJoCo: one step of the plant that `zwang run` simulates.
#include <mujoco/mujoco.h>

#include <cstdlib>
#include <cstring>
#include <memory>

#include "workload.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/lang/scene.hpp"
#include "zwang/runtime/mujoco_plant.hpp"

namespace zwang::bench {

namespace {

struct Step {
  explicit Step(const std::string& mjcf) {
    mjVFS files;
    mj_defaultVFS(&files);
    mj_makeEmptyFileVFS(&files, "plant.xml", static_cast<int>(mjcf.size()));
    std::memcpy(files.filedata[0], mjcf.data(), mjcf.size());
    char error[512] = "";
    model = mj_loadXML("plant.xml", &files, error, sizeof(error));
    mj_deleteVFS(&files);
    if (model == nullptr) std::abort();
    data = mj_makeData(model);
    for (int i = 0; i < 500; ++i) mj_step(model, data);  // it settles on its wheels
    for (int i = 0; i < model->nu; ++i) data->ctrl[i] = 0.1 * (i + 1);
  }
  ~Step() {
    mj_deleteData(data);
    mj_deleteModel(model);
  }
  mjModel* model = nullptr;
  mjData* data = nullptr;
};

}  // namespace

Workload mujoco_step() {
  lang::Diagnostics diagnostics;
  const auto robot = lang::load_robot(ZWANG_SOURCE_DIR "/specs/robots/mecanum_base.yaml", diagnostics);
  if (!robot) std::abort();
  const runtime::MujocoPlant plant(*robot, lang::Scene{}, {.period = 1e-3});
  auto w = std::make_shared<Step>(plant.mjcf());
  return {"mj_step, set as the plant", "dynamics, contacts of the wheels, one Euler step",
          [w](std::size_t) { mj_step(w->model, w->data); }};
}

}  // namespace zwang::bench
