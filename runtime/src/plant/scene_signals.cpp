#include "scene_signals.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "outline.hpp"
#include "schedule/frame_table.hpp"
#include "zwang/lang/object_outline.hpp"
#include "zwang/lang/plane.hpp"

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
    case SceneSignalKind::force:
    case SceneSignalKind::travel:
      return type == SignalType::boolean || type == SignalType::number;
    case SceneSignalKind::wrench:
      return type == SignalType::boolean || type == SignalType::wrench;
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

/// The dock of what has this number.
const std::optional<lang::Dock>* dock_of(const lang::Scene& scene, int number) {
  const auto objects = static_cast<int>(scene.objects.size());
  if (number < 0 || number == objects) return nullptr;
  if (number < objects) return &scene.objects[static_cast<std::size_t>(number)].dock;
  return &scene.robots[static_cast<std::size_t>(number - objects - 1)].dock;
}

/// Throws std::invalid_argument where the robot has no such frame.
solver::AttachedFrame frame_of(const solver::Model& model, const std::string& name) {
  const auto number = model.find_frame(name);
  if (!number) throw std::invalid_argument("scene: the robot has no frame `" + name + "` for a sensor");
  const solver::Frame& frame = model.frames()[static_cast<std::size_t>(*number)];
  return {frame.body, frame.pose_in_body, {}};
}

/// The robot's frame that latches in what is seen.
std::optional<solver::AttachedFrame> hook_of(const lang::Scene& scene, const SceneSignal& signal,
                                             const solver::Model& model) {
  const auto* dock = dock_of(scene, signal.object);
  const auto number = dock != nullptr && *dock ? model.find_frame((*dock)->hook) : std::nullopt;
  if (!number) return std::nullopt;
  const solver::Frame& frame = model.frames()[static_cast<std::size_t>(*number)];
  return solver::AttachedFrame{frame.body, frame.pose_in_body, {}};
}

}  // namespace

SceneSignals::SceneSignals(const lang::Program& program, const lang::Scene& scene,
                           const std::vector<SceneSignal>& signals,
                           std::vector<std::vector<solver::Vector3>> footprints, std::uint64_t seed,
                           int number)
    : model_(program.robot.model), number_(static_cast<std::size_t>(number)), scene_(scene) {
  for (std::vector<solver::Vector3>& footprint : footprints)
    footprints_.push_back(lang::plane::convex_hull(std::move(footprint)));
  for (const lang::SceneObject& object : scene.objects) {
    leaning_.push_back(object.leans() ? lang::outline_of(object, program.robot.bumper_height)
                                      : std::vector<solver::Vector3>{});
    // An object that is too low for the bumper is seen by its foot.
    if (object.leans() && leaning_.back().empty()) leaning_.back() = lang::outline_of(object, 0.0);
  }
  for (const SceneSignal& signal : signals) {
    for (std::size_t i = 0; i < program.signals.size(); ++i) {
      const lang::Signal& declared = program.signals[i];
      if (declared.name != signal.name) continue;
      if (!gives(signal.kind, declared.type))
        throw std::invalid_argument("scene: signal `" + signal.name +
                                    "` is not of the type that the task file says");
      Source source;
      source.signal = signal;
      source.index = static_cast<int>(i);
      source.in_scene = static_cast<std::size_t>(&signal - signals.data());
      source.type = declared.type;
      if (signal.kind == SceneSignalKind::wrench) source.sensor = frame_of(model_, signal.frame);
      if (declared.type == SignalType::pose || declared.type == SignalType::wrench)
        source.in = attached_frame(program, declared.in);
      if (signal.kind == SceneSignalKind::pose) source.hook = hook_of(scene_, signal, model_);
      source.on_way.resize(ring);
      source.noise = Noise(seed * 0x9E3779B97F4A7C15U + i + 1);
      if (signal.delay > 1.9)
        throw std::invalid_argument("scene: signal `" + signal.name + "` is delayed by more than 1.9 s");
      sources_.push_back(std::move(source));
    }
  }
}

void SceneSignals::measure_base(const SceneSignal& fix, std::uint64_t seed) {
  Source source;
  source.signal = fix;
  source.type = SignalType::pose;
  source.in = {-1, {}, {}};
  source.on_way.resize(ring);
  source.noise = Noise(seed);
  base_ = std::move(source);
}

SceneSignals::PlanarPose SceneSignals::pose_of(const Truth& truth, int number) const noexcept {
  const auto objects = static_cast<int>(scene_.objects.size());
  if (number == objects) return {truth.x, truth.y, truth.yaw};
  // In the truth the scene's robots follow its objects: the first robot is not among them.
  const ObjectTruth& seen = truth.objects[static_cast<std::size_t>(number < objects ? number : number - 1)];
  return {seen.x, seen.y, seen.yaw};
}

bool SceneSignals::is_latched(const Truth& truth, int number) const noexcept {
  const auto objects = static_cast<int>(scene_.objects.size());
  if (number == objects) return false;
  return truth.objects[static_cast<std::size_t>(number < objects ? number : number - 1)].latched.has_value();
}

double SceneSignals::force(const Truth& truth, int number) const noexcept {
  const auto objects = static_cast<int>(scene_.objects.size());
  if (number == objects) return 0.0;
  return truth.objects[static_cast<std::size_t>(number < objects ? number : number - 1)].force;
}

SceneSignals::PlanarPose SceneSignals::seen_pose(const Truth& truth, int number) const noexcept {
  const PlanarPose at = pose_of(truth, number);
  const auto* dock = dock_of(scene_, number);
  if (dock == nullptr || !*dock) return at;
  const double c = std::cos(at.yaw), s = std::sin(at.yaw);
  const double x = (*dock)->at[0], y = (*dock)->at[1];
  return {at.x + c * x - s * y, at.y + s * x + c * y, at.yaw + std::atan2(-y, -x)};
}

double SceneSignals::distance(const Truth& truth, int number, const solver::State& state) const noexcept {
  const PlanarPose at = pose_of(truth, number);
  const double c = std::cos(at.yaw), s = std::sin(at.yaw);
  const double dx = state.base_pose.position.x() - at.x, dy = state.base_pose.position.y() - at.y;
  // The base's origin in the object's own axes, from `at`.
  const double x = c * dx + s * dy, y = -s * dx + c * dy;
  const auto objects = static_cast<int>(scene_.objects.size());
  if (number >= objects) return distance_to(footprints_[static_cast<std::size_t>(number - objects)], x, y);
  const lang::SceneObject& described = scene_.objects[static_cast<std::size_t>(number)];
  if (described.leans()) return distance_to(leaning_[static_cast<std::size_t>(number)], x, y);
  if (described.shape == lang::ShapeKind::cylinder)
    return std::max(0.0, std::hypot(x, y) - described.size[0]);
  const bool is_wall = described.shape == lang::ShapeKind::wall;
  const double half_x = 0.5 * (is_wall ? described.size[1] : described.size[0]);
  const double half_y = 0.5 * (is_wall ? described.size[0] : described.size[1]);
  const double centre = is_wall ? half_x : 0.0;
  return std::hypot(std::max(0.0, std::abs(x - centre) - half_x), std::max(0.0, std::abs(y) - half_y));
}

solver::ForceVector SceneSignals::wrench(Source& source, const Truth& truth,
                                         const solver::State& state) const noexcept {
  solver::ForceVector felt = truth.wrenches[number_][source.in_scene];
  const double noise = source.signal.noise;
  for (int k = 0; k < 3; ++k) {
    felt.linear(k) += source.signal.force_bias[static_cast<std::size_t>(k)] + noise * source.noise.normal();
    felt.angular(k) += noise * lang::Feels::moment_arm * source.noise.normal();
  }
  const solver::Pose from_sensor = solver::motion_of(source.in, model_, state).pose.inverse() *
                                   solver::motion_of(source.sensor, model_, state).pose;
  const solver::Vector3 force = from_sensor.rotation * felt.linear;
  return {from_sensor.rotation * felt.angular + from_sensor.position.cross(force), force};
}

solver::Pose SceneSignals::pose(Source& source, const Truth& truth,
                                const solver::State& state) const noexcept {
  const bool is_own = source.signal.object < 0;
  const double yaw = solver::yaw_of(state.base_pose.rotation);
  const PlanarPose at = is_own ? PlanarPose{state.base_pose.position.x(), state.base_pose.position.y(), yaw}
                               : seen_pose(truth, source.signal.object);
  const solver::FrameMotion in = solver::motion_of(source.in, model_, state);
  // Scenes are flat: a socket is as high as the hook that fits, anything else as high as who sees it.
  const solver::Pose seen_from = source.hook ? solver::motion_of(*source.hook, model_, state).pose : in.pose;
  solver::Pose seen;
  seen.position = {at.x + source.signal.noise * source.noise.normal(),
                   at.y + source.signal.noise * source.noise.normal(), seen_from.position.z()};
  seen.rotation =
      solver::rotation_from_rpy(0.0, 0.0, at.yaw + source.signal.angle_noise * source.noise.normal());
  return in.pose.inverse() * seen;
}

SignalSample SceneSignals::measured(Source& source, const Truth& truth,
                                    const solver::State& state) const noexcept {
  SignalSample sample;
  sample.type = source.type;
  sample.valid = true;
  sample.stamp = truth.time;
  const SceneSignal& signal = source.signal;
  const int number = std::max(signal.object, 0);
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
      sample.boolean = is_latched(truth, number);
      break;
    case SceneSignalKind::force:
      sample.number = force(truth, number) + signal.bias + signal.noise * source.noise.normal();
      if (signal.beyond) sample.boolean = std::abs(sample.number) >= *signal.beyond;
      break;
    case SceneSignalKind::travel:
      sample.number = truth.objects[static_cast<std::size_t>(number)].travel +
                      (signal.powers[3] != 0 ? signal.angle_noise : signal.noise) * source.noise.normal();
      if (signal.beyond)
        sample.boolean =
            *signal.beyond < 0.0 ? sample.number <= *signal.beyond : sample.number >= *signal.beyond;
      break;
    case SceneSignalKind::wrench:
      sample.wrench = wrench(source, truth, state);
      if (signal.beyond) sample.boolean = sample.wrench.linear.norm() >= *signal.beyond;
      break;
    case SceneSignalKind::distance:
      sample.number = std::max(0.0, distance(truth, number, state) + signal.noise * source.noise.normal());
      break;
    case SceneSignalKind::pose:
      sample.pose = pose(source, truth, state);
      break;
  }
  return sample;
}

void SceneSignals::measure(Source& source, const Truth& truth, const solver::State& state) noexcept {
  if (source.last_measured >= 0.0 && truth.time < source.last_measured + source.signal.period - tick_rounding)
    return;
  source.last_measured = truth.time;
  SignalSample sample = measured(source, truth, state);
  if (source.signal.dropouts > 0.0 && source.noise.uniform() < source.signal.dropouts) sample.valid = false;
  if (source.is_blocked) sample.valid = false;
  source.on_way[source.next++ % ring] = sample;
}

void SceneSignals::block(const std::vector<bool>& blocked) noexcept {
  for (Source& source : sources_) {
    const auto index = static_cast<std::size_t>(source.index);
    source.is_blocked = index < blocked.size() && blocked[index];
  }
}

void SceneSignals::measure(const Truth& truth, const solver::State& state) noexcept {
  for (Source& source : sources_) measure(source, truth, state);
  if (base_) measure(*base_, truth, state);
}

const SignalSample* SceneSignals::arrived(const Source& source, double time) noexcept {
  for (std::size_t back = 1; back <= std::min(source.next, ring); ++back) {
    const SignalSample& sample = source.on_way[(source.next - back) % ring];
    if (sample.stamp + source.signal.delay <= time + tick_rounding) return &sample;
  }
  return nullptr;
}

void SceneSignals::report(double time, std::vector<SignalSample>& samples) const noexcept {
  for (const Source& source : sources_) {
    const auto index = static_cast<std::size_t>(source.index);
    if (index >= samples.size()) continue;
    if (const SignalSample* sample = arrived(source, time)) samples[index] = *sample;
  }
}

std::optional<MeasuredPose> SceneSignals::base_fix(double time) const noexcept {
  const SignalSample* sample = base_ ? arrived(*base_, time) : nullptr;
  if (sample == nullptr || !sample->valid) return std::nullopt;
  return MeasuredPose{sample->stamp, sample->pose};
}

}  // namespace zwang::runtime
