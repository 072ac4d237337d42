#include "scene_signals.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "object_geometry.hpp"
#include "schedule/frame_table.hpp"

namespace zwang::runtime {

using lang::SceneSignal;
using lang::SceneSignalKind;
using lang::SignalType;

namespace {

constexpr std::size_t ring = 2048;  ///< measurements on their way: 2 s of delay at one a millisecond
constexpr double tick_rounding = 1e-9;

bool gives(SceneSignalKind kind, SignalType type) {
  switch (kind) {
    case SceneSignalKind::script:
      return type == SignalType::boolean || type == SignalType::number;
    case SceneSignalKind::pose:
      return type == SignalType::pose;
    case SceneSignalKind::distance:
      return type == SignalType::number;
    case SceneSignalKind::latch:
      return type == SignalType::boolean;
  }
  return false;
}

/// The frame as it hangs on the robot or in the world; frames on pose signals see nothing by themselves.
solver::AttachedFrame attached_frame(const lang::Program& program, int frame) {
  const lang::FrameDeclaration& declared = program.frames[static_cast<std::size_t>(frame)];
  switch (declared.parent) {
    case lang::FrameParent::world:
      return {-1, declared.pose, {}};
    case lang::FrameParent::body:
      return {declared.parent_index, declared.pose, {}};
    case lang::FrameParent::frame:
      return carried(attached_frame(program, declared.parent_index), declared.pose);
    case lang::FrameParent::signal:
      break;
  }
  throw std::invalid_argument("scene: the frame `" + declared.name +
                              "` hangs on a signal: nothing is seen from it");
}

}  // namespace

double Noise::uniform() noexcept {
  return static_cast<double>(engine_() >> 11U) * 0x1.0p-53;
}

double Noise::normal() noexcept {
  // Box and Muller: sqrt(-2 ln u) cos(2 pi v).
  const double u = 1.0 - uniform();
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * uniform());
}

namespace {

/// The robot's frame that latches in the object that is seen.
std::optional<solver::AttachedFrame> hook_of(const std::vector<lang::SceneObject>& objects,
                                             const SceneSignal& signal, const solver::Model& model) {
  if (signal.object < 0) return std::nullopt;
  const auto& dock = objects[static_cast<std::size_t>(signal.object)].dock;
  const auto number = dock ? model.find_frame(dock->hook) : std::nullopt;
  if (!number) return std::nullopt;
  const solver::Frame& frame = model.frames()[static_cast<std::size_t>(*number)];
  return solver::AttachedFrame{frame.body, frame.pose_in_body, {}};
}

}  // namespace

SceneSignals::SceneSignals(const lang::Program& program, std::uint64_t seed) : model_(program.robot.model) {
  if (!program.scene) return;
  objects_ = program.scene->objects;
  for (const SceneSignal& signal : program.scene->signals) {
    for (std::size_t i = 0; i < program.signals.size(); ++i) {
      const lang::Signal& declared = program.signals[i];
      if (declared.name != signal.name) continue;
      if (!gives(signal.kind, declared.type))
        throw std::invalid_argument("scene: signal `" + signal.name +
                                    "` is not of the type that the task file says");
      Source source;
      source.signal = signal;
      source.index = static_cast<int>(i);
      source.type = declared.type;
      if (declared.type == SignalType::pose) source.in = attached_frame(program, declared.in);
      if (signal.kind == SceneSignalKind::pose) source.hook = hook_of(objects_, signal, model_);
      source.on_way.resize(ring);
      source.noise = Noise(seed * 0x9E3779B97F4A7C15U + i + 1);
      if (signal.delay > 1.9)
        throw std::invalid_argument("scene: signal `" + signal.name + "` is delayed by more than 1.9 s");
      sources_.push_back(std::move(source));
    }
  }
}

SceneSignals::PlanarPose SceneSignals::seen_pose(const ObjectTruth& object,
                                                 std::size_t number) const noexcept {
  const auto& dock = objects_[number].dock;
  if (!dock) return {object.x, object.y, object.yaw};
  const double c = std::cos(object.yaw), s = std::sin(object.yaw);
  return {object.x + c * dock->at[0] - s * dock->at[1], object.y + s * dock->at[0] + c * dock->at[1],
          object.yaw + std::atan2(-dock->at[1], -dock->at[0])};
}

double SceneSignals::distance(const ObjectTruth& object, std::size_t number,
                              const Truth& truth) const noexcept {
  const lang::SceneObject& described = objects_[number];
  const double c = std::cos(object.yaw), s = std::sin(object.yaw);
  const double dx = truth.x - object.x, dy = truth.y - object.y;
  // The base's origin in the object's own axes, from `at`.
  const double x = c * dx + s * dy, y = -s * dx + c * dy;
  if (described.shape == lang::ShapeKind::cylinder)
    return std::max(0.0, std::hypot(x, y) - described.size[0]);
  const bool is_wall = described.shape == lang::ShapeKind::wall;
  const double half_x = 0.5 * (is_wall ? described.size[1] : described.size[0]);
  const double half_y = 0.5 * (is_wall ? described.size[0] : described.size[1]);
  const double centre = is_wall ? half_x : 0.0;
  return std::hypot(std::max(0.0, std::abs(x - centre) - half_x), std::max(0.0, std::abs(y) - half_y));
}

SignalSample SceneSignals::measured(Source& source, const Truth& truth,
                                    const solver::State& state) const noexcept {
  SignalSample sample;
  sample.valid = true;
  sample.stamp = truth.time;
  const SceneSignal& signal = source.signal;
  const auto number = static_cast<std::size_t>(std::max(signal.object, 0));
  switch (signal.kind) {
    case SceneSignalKind::script: {
      sample.valid = false;
      for (const lang::ScriptStep& step : signal.script) {
        if (step.time > truth.time + tick_rounding) break;
        sample.valid = step.valid;
        sample.number = step.value;
      }
      sample.boolean = sample.number != 0.0;
      break;
    }
    case SceneSignalKind::latch:
      sample.boolean = truth.objects[number].latched;
      break;
    case SceneSignalKind::distance:
      sample.number = std::max(
          0.0, distance(truth.objects[number], number, truth) + signal.noise * source.noise.normal());
      break;
    case SceneSignalKind::pose: {
      const PlanarPose at = seen_pose(truth.objects[number], number);
      const solver::FrameMotion in = solver::motion_of(source.in, model_, state);
      // Scenes are flat: a socket is as high as the hook that fits, anything else as high as who sees it.
      const solver::Pose seen_from =
          source.hook ? solver::motion_of(*source.hook, model_, state).pose : in.pose;
      solver::Pose seen;
      seen.position = {at.x + signal.noise * source.noise.normal(),
                       at.y + signal.noise * source.noise.normal(), seen_from.position.z()};
      seen.rotation =
          solver::rotation_from_rpy(0.0, 0.0, at.yaw + signal.angle_noise * source.noise.normal());
      sample.pose = in.pose.inverse() * seen;
      break;
    }
  }
  return sample;
}

void SceneSignals::measure(const Truth& truth, const solver::State& state) noexcept {
  for (Source& source : sources_) {
    if (source.last_measured >= 0.0 &&
        truth.time < source.last_measured + source.signal.period - tick_rounding)
      continue;
    source.last_measured = truth.time;
    SignalSample sample = measured(source, truth, state);
    if (source.signal.dropouts > 0.0 && source.noise.uniform() < source.signal.dropouts) sample.valid = false;
    source.on_way[source.next++ % ring] = sample;
  }
}

void SceneSignals::report(double time, std::vector<SignalSample>& samples) const noexcept {
  for (const Source& source : sources_) {
    const auto index = static_cast<std::size_t>(source.index);
    if (index >= samples.size()) continue;
    // The youngest that has arrived.
    for (std::size_t back = 1; back <= std::min(source.next, ring); ++back) {
      const SignalSample& sample = source.on_way[(source.next - back) % ring];
      if (sample.stamp + source.signal.delay > time + tick_rounding) continue;
      samples[index] = sample;
      break;
    }
  }
}

}  // namespace zwang::runtime
