// The plant's true values, as columns of a log.
#include <algorithm>

#include "place_columns.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {

void add_place_columns(const std::string& name, std::vector<Column>& columns) {
  columns.push_back({"truth." + name + ".x", "m", {}});
  columns.push_back({"truth." + name + ".y", "m", {}});
  columns.push_back({"truth." + name + ".yaw", "rad", {}});
}

std::vector<Column> base_truth_columns() {
  return {{"truth.base.x", "m", {}},       {"truth.base.y", "m", {}},
          {"truth.base.yaw", "rad", {}},   {"truth.base.roll", "rad", {}},
          {"truth.base.pitch", "rad", {}}, {"truth.base.acceleration", "m/s^2", {}},
          {"truth.base.push", "N", {}},    {"truth.base.slip", "m/s", {}}};
}

BaseTruthValues base_truth_values(double x, double y, double yaw, const BaseTruth& base) noexcept {
  return {x, y, yaw, base.roll, base.pitch, base.acceleration, base.push, base.slip};
}

std::vector<Column> truth_columns(const lang::Scene& scene) {
  std::vector<Column> columns = base_truth_columns();
  for (const lang::SceneObject& o : scene.objects) columns.push_back({"truth." + o.name + ".force", "N", {}});
  for (const lang::SceneRobot& r : scene.robots) columns.push_back({"truth." + r.name + ".force", "N", {}});
  for (const lang::SceneObject& o : scene.objects) {
    if (o.moves()) add_place_columns(o.name, columns);
  }
  for (const lang::SceneRobot& r : scene.robots) add_place_columns(r.name, columns);
  for (const lang::SceneObject& o : scene.objects) {
    if (o.guide && o.guide->turns) columns.push_back({"truth." + o.name + ".angle", "rad", {}});
    if (o.guide && !o.guide->turns) columns.push_back({"truth." + o.name + ".travel", "m", {}});
  }
  return columns;
}

/// The truth's objects are the scene's objects, then its robots.
void put_truth(const Truth& truth, const lang::Scene& scene, std::span<double> values) {
  const BaseTruthValues base = base_truth_values(truth.x, truth.y, truth.yaw, truth.base);
  std::copy(base.begin(), base.end(), values.begin());
  std::size_t at = base.size();
  for (const ObjectTruth& o : truth.objects) values[at++] = o.force;
  for (std::size_t i = 0; i < truth.objects.size(); ++i) {
    if (i < scene.objects.size() && !scene.objects[i].moves()) continue;
    const ObjectTruth& o = truth.objects[i];
    for (const double place : {o.x, o.y, o.yaw}) values[at++] = place;
  }
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (scene.objects[i].guide) values[at++] = truth.objects[i].travel;
  }
}

}  // namespace zwang::runtime
