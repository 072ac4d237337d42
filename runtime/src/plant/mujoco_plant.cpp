#include "zwang/runtime/mujoco_plant.hpp"

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "base_watch.hpp"
#include "contact_friction.hpp"
#include "contact_reader.hpp"
#include "moving_robot.hpp"
#include "simulated_object.hpp"
#include "simulator.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::runtime {

namespace {

using solver::Matrix3;
using solver::Vector3;

constexpr double settling_time = 0.5;   ///< [s] before t = 0, without torque
constexpr double start_overlap = 1e-5;  ///< [m] allowed between robot and objects at the start

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("plant: " + what);
}

std::string numbered(const char* name, int number) {
  return std::string(name) + '_' + std::to_string(number);
}

bool is_finite(const mjtNum* numbers, int count) {
  return std::all_of(numbers, numbers + count, [](mjtNum x) { return std::isfinite(x); });
}

double yaw_of(const Matrix3& rotation) {
  return std::atan2(rotation(1, 0), rotation(0, 0));
}

}  // namespace

struct MujocoPlant::Simulation {
  Simulation(const lang::Robot& robot, const lang::Scene& scene, const MujocoPlantOptions& options) {
    install_handlers();
    if (!(options.period > 0.0) || options.period > 0.01) refuse("the period is not within 0 and 10 ms");
    const std::vector<SimulatedRobot> described =
        describe_robots(robot, scene, options.real_rollers || scene.real_rollers);
    for (const SimulatedRobot& one : described) robots.emplace_back(one, scene.floor_friction);
    text = write_mjcf(described, scene, options.period);
    model = compile(text);
    data.reset(mj_makeData(model.get()));
    if (!data) refuse("MuJoCo has no memory for the simulation");
    find_addresses();
    for (const SimulatedRobot& one : described) require_as_written(*model, one);
    const std::vector<GeomOwner> owners = find_owners(*model, described);
    contacts = ContactReader(owners, set_springs(*model, owners, scene, described), robots.size(),
                             scene.objects.size());
    contact_friction = ContactFriction(*model, owners);
    for (const MovingRobot& one : robots) watches.emplace_back(one, options.period);
    truth.corner_forces.assign(robot.footprint.size(), 0.0);
    for (const lang::SceneObject& object : scene.objects)
      truth.objects.push_back({object.name, 0.0, {}, 0.0});
    for (const lang::SceneRobot& other : scene.robots) {
      truth.objects.push_back({other.name, 0.0, {}, 0.0});
      truth.robots.emplace_back();
    }
    find_objects(scene);
    find_docks(scene);
    std::vector<Start> starts{
        {options.start_at.value_or(scene.start_at), options.start_yaw.value_or(scene.start_yaw)}};
    for (const lang::SceneRobot& other : scene.robots) starts.push_back({other.at, other.yaw});
    start(starts);
  }

  static std::vector<SimulatedRobot> describe_robots(const lang::Robot& robot, const lang::Scene& scene,
                                                     bool real_rollers) {
    std::vector<SimulatedRobot> described{prepare_robot(robot, real_rollers)};
    for (std::size_t r = 0; r < scene.robots.size(); ++r) {
      const auto& program = scene.robots[r].program;
      if (!program) refuse("the task file of the robot `" + scene.robots[r].name + "` was not loaded");
      described.push_back(prepare_robot(program->robot, real_rollers, static_cast<int>(r) + 1));
    }
    return described;
  }

  struct Start {
    std::array<double, 2> at;
    double yaw;
  };

  /// A socket: of an object, or of one of the scene's robots.
  struct SimulatedDock {
    std::size_t owner = 0;  ///< in the truth's objects
    lang::Dock dock;
    int body = 0;  ///< that the hook is tied to
    int equality = -1;
    int hook_body = 0;
    Vector3 hook = Vector3::Zero();  ///< [m] in that body
  };

  MovingRobot& first() noexcept { return robots.front(); }
  const MovingRobot& first() const noexcept { return robots.front(); }

  int id_of(mjtObj type, const std::string& name) const {
    return mj_name2id(model.get(), type, name.c_str());
  }

  void find_addresses() {
    int freedoms = 0;
    for (MovingRobot& robot : robots) {
      robot.find_addresses(*model);
      freedoms += robot.freedoms();
    }
    for (int j = 0; j < model->njnt; ++j) {
      const char* name = mj_id2name(model.get(), mjOBJ_JOINT, j);
      if (std::strncmp(name, "object_", 7) == 0) freedoms += 1;
    }
    if (model->nv != freedoms) refuse("MuJoCo changed the number of freedoms");
  }

  void find_objects(const lang::Scene& scene) {
    for (std::size_t k = 0; k < scene.objects.size(); ++k) {
      const lang::SceneObject& object = scene.objects[k];
      const std::string name = numbered("object", static_cast<int>(k));
      SimulatedObject simulated_object{.described = object, .geometry = geometry_of(object)};
      simulated_object.body = id_of(mjOBJ_BODY, name);
      const int joint = id_of(mjOBJ_JOINT, name + "_x");
      if (joint >= 0) {
        simulated_object.position = model->jnt_qposadr[joint];
        simulated_object.velocity = model->jnt_dofadr[joint];
      }
      if (object.mass)
        simulated_object.friction =
            floor_friction_of(object, scene.floor_friction, first().model().gravity().norm());
      objects.push_back(std::move(simulated_object));
    }
  }

  void find_docks(const lang::Scene& scene) {
    const auto add = [&](std::size_t owner, const std::string& name, const lang::Dock& dock, int body) {
      const solver::Frame& hook = hook_of(first().model(), dock, name);
      docks.push_back({owner, dock, body, id_of(mjOBJ_EQUALITY, numbered("dock", static_cast<int>(owner))),
                       id_of(mjOBJ_BODY, numbered("body", hook.body)), hook.pose_in_body.position});
    };
    for (std::size_t k = 0; k < objects.size(); ++k) {
      if (scene.objects[k].dock) add(k, scene.objects[k].name, *scene.objects[k].dock, objects[k].body);
    }
    for (std::size_t r = 0; r < scene.robots.size(); ++r) {
      const lang::SceneRobot& robot = scene.robots[r];
      if (robot.dock) add(objects.size() + r, robot.name, *robot.dock, robots[r + 1].base_body());
    }
  }

  /// A hook that is near enough to its socket is tied to the object where it is.
  void latch_hooks() noexcept {
    for (const SimulatedDock& dock : docks) {
      if (truth.objects[dock.owner].latched) continue;
      const Vector3 hook = vector_of(data->xpos + 3 * dock.hook_body) +
                           matrix_of(data->xquat + 4 * dock.hook_body) * dock.hook;
      if (!is_in_reach(dock.dock, truth.objects[dock.owner], hook)) continue;
      Eigen::Map<Vector3>(model->eq_data + mjNEQDATA * dock.equality) = dock.hook;
      Eigen::Map<Vector3>(model->eq_data + mjNEQDATA * dock.equality + 3) =
          matrix_of(data->xquat + 4 * dock.body).transpose() * (hook - vector_of(data->xpos + 3 * dock.body));
      model->eq_active[dock.equality] = 1;
      truth.objects[dock.owner].latched = time();
      contacts.note_catch(0, time());
    }
  }

  /// MuJoCo's tie pushes the hook with `f`, and so the dock with -f: pull = -f . n, n outwards.
  void read_pulls() noexcept {
    for (const SimulatedDock& dock : docks) {
      ObjectTruth& owner = truth.objects[dock.owner];
      const double outwards = owner.yaw + std::atan2(dock.dock.at[1], dock.dock.at[0]);
      for (int row = 0; row + 2 < data->ne; row += 3) {
        if (data->efc_id[row] != dock.equality) continue;
        const mjtNum* f = data->efc_force + row;
        owner.pull = -(f[0] * std::cos(outwards) + f[1] * std::sin(outwards));
        const Vector3 hook = vector_of(data->xpos + 3 * dock.hook_body) +
                             matrix_of(data->xquat + 4 * dock.hook_body) * dock.hook;
        contacts.add_push(0, {f[0], f[1]}, hook.head<2>());
        if (dock.owner >= objects.size())
          contacts.add_push(dock.owner - objects.size() + 1, {-f[0], -f[1]}, hook.head<2>());
      }
    }
  }

  void read_objects() noexcept {
    for (std::size_t k = 0; k < objects.size(); ++k) {
      const int body = objects[k].body;
      place_truth(objects[k], vector_of(data->xpos + 3 * body), matrix_of(data->xquat + 4 * body),
                  truth.objects[k]);
    }
    for (std::size_t r = 1; r < robots.size(); ++r) {
      ObjectTruth& seen = truth.objects[objects.size() + r - 1];
      const Vector3 at = robots[r].base_position(*model, *data);
      seen.x = at.x();
      seen.y = at.y();
      seen.yaw = yaw_of(robots[r].base_rotation(*model, *data));
      truth.robots[r - 1].velocity = robots[r].planar_twist(*model, *data);
    }
  }

  void set_floor_friction(double coefficient) noexcept {
    for (int p = 0; p < model->npair; ++p) {
      if (rolling_in(p).wheel >= 0) set_pair_friction(p, coefficient);
    }
    for (MovingRobot& robot : robots) robot.set_floor_friction(coefficient);
  }

  void set_wheel_friction(std::size_t robot, std::size_t wheel, double coefficient) noexcept {
    for (int p = 0; p < model->npair; ++p) {
      const GeomOwner& rolling = rolling_in(p);
      if (rolling.wheel == static_cast<int>(wheel) && rolling.robot == static_cast<int>(robot))
        set_pair_friction(p, coefficient);
    }
    robots[robot].set_floor_friction(coefficient, wheel);
  }

  /// Of a pair of geoms that may touch the one that rolls, if any does.
  const GeomOwner& rolling_in(int pair) const {
    const GeomOwner& one = owner_of(model->pair_geom1[pair]);
    return one.wheel >= 0 ? one : owner_of(model->pair_geom2[pair]);
  }

  void set_pair_friction(int pair, double coefficient) noexcept {
    mjtNum* friction = model->pair_friction + 5 * pair;
    // Skidding wheels have next to none in the second direction.
    if (friction[1] == friction[0]) friction[1] = coefficient;
    friction[0] = coefficient;
  }

  const GeomOwner& owner_of(int geom) const { return contacts.owner_of(geom); }

  /// Lets the robots sink into their wheels' contacts, then puts them exactly where they start, at rest, at
  /// t = 0: of the settled pose, height and tilt of the base are kept.
  void start(const std::vector<Start>& starts) {
    for (std::size_t r = 0; r < robots.size(); ++r)
      robots[r].place(*model, *data, starts[r].at, starts[r].yaw);
    if (!guarded(mj_forward, model.get(), data.get())) refuse("MuJoCo fails at the start pose");
    refuse_overlap();
    const auto on_ground = [](const MovingRobot& robot) { return robot.is_on_ground(); };
    if (std::any_of(robots.begin(), robots.end(), on_ground)) settle(starts);
    read_base();
    read_objects();
    look_for_falls();
    truth.velocity.setZero();
    truth.acceleration.setZero();
  }

  void settle(const std::vector<Start>& starts) {
    const std::vector<mjtNum> standing(data->qpos, data->qpos + model->nq);
    const int steps = static_cast<int>(settling_time / model->opt.timestep);
    for (int i = 0; i < steps; ++i) {
      if (!step()) refuse("the simulation diverges while the robot settles on the floor");
      for (const MovingRobot& robot : robots) robot.hold_joints(*data);
    }
    std::fill(data->qfrc_applied, data->qfrc_applied + model->nv, 0.0);
    std::vector<std::pair<double, Matrix3>> settled;
    for (MovingRobot& robot : robots) {
      robot.forget_bristles();
      settled.emplace_back(robot.base_position(*model, *data).z(), robot.base_rotation(*model, *data));
    }
    std::copy(standing.begin(), standing.end(), data->qpos);
    for (std::size_t r = 0; r < robots.size(); ++r) {
      if (robots[r].is_on_ground())
        robots[r].stand(*data, starts[r].yaw, settled[r].first, settled[r].second);
    }
    std::fill(data->qvel, data->qvel + model->nv, 0.0);
    data->time = 0.0;
    if (!guarded(mj_forward, model.get(), data.get())) refuse("MuJoCo fails at the start pose");
  }

  void refuse_overlap() const {
    for (int c = 0; c < data->ncon; ++c) {
      const mjContact& contact = data->contact[c];
      const GeomOwner &one = owner_of(contact.geom1), &other = owner_of(contact.geom2);
      const GeomOwner& robot = one.touches ? one : other;
      const GeomOwner& met = one.touches ? other : one;
      if (!robot.touches || contact.dist >= -start_overlap) continue;
      if (met.object < 0 && !met.touches) continue;
      char depth[32];
      std::snprintf(depth, sizeof depth, " by %.3g mm", -contact.dist * 1e3);
      refuse(name_of(robot) + " starts inside " + name_of(met) + depth);
    }
  }

  std::string name_of(const GeomOwner& owner) const {
    if (owner.object < 0 && owner.robot == 0) return "the robot";
    const auto index = owner.object >= 0 ? static_cast<std::size_t>(owner.object)
                                         : objects.size() + static_cast<std::size_t>(owner.robot) - 1;
    return "`" + truth.objects[index].name + "`";
  }

  /// One step; false when the simulation is void.
  bool step() noexcept {
    const double before = data->time;
    for (MovingRobot& robot : robots) robot.push(*model, *data);
    for (SimulatedObject& object : objects) {
      follow_script(object, time(), data->qpos, data->qvel);
      add_floor_friction(object, model->opt.timestep, data->qvel, data->qfrc_applied);
    }
    contact_friction.push(*model, *data);
    press_by_hand();
    if (!guarded(mj_step, model.get(), data.get())) return false;
    read_loads();
    const double elapsed = data->time - before;
    if (!(std::abs(elapsed - model->opt.timestep) < 1e-6 * model->opt.timestep)) return false;
    for (const mjWarningStat& warning : data->warning) {
      if (warning.number > 0) return false;
    }
    return is_finite(data->qpos, model->nq) && is_finite(data->qvel, model->nv) &&
           is_finite(data->qacc, model->nv);
  }

  void read_loads() noexcept {
    bool is_needed = false;
    for (MovingRobot& robot : robots) {
      is_needed = is_needed || robot.needs_loads();
      std::fill(robot.wheel_loads().begin(), robot.wheel_loads().end(), 0.0);
    }
    for (int c = 0; is_needed && c < data->ncon; ++c) {
      const GeomOwner &one = owner_of(data->contact[c].geom1), &other = owner_of(data->contact[c].geom2);
      const GeomOwner& rolling = one.wheel >= 0 ? one : other;
      if (rolling.wheel < 0) continue;
      std::array<mjtNum, 6> wrench{};
      mj_contactForce(model.get(), data.get(), c, wrench.data());
      robots[static_cast<std::size_t>(rolling.robot)]
          .wheel_loads()[static_cast<std::size_t>(rolling.wheel)] += wrench[0];
    }
  }

  void read_base() noexcept {
    truth.time = time();
    const Vector3 at = first().base_position(*model, *data);
    truth.x = at.x();
    truth.y = at.y();
    truth.yaw = yaw_of(first().base_rotation(*model, *data));
    for (std::size_t r = 0; r < robots.size(); ++r)
      BaseWatch::read_lean(robots[r], *model, *data, base_truth(r));
  }

  BaseTruth& base_truth(std::size_t robot) noexcept {
    return robot == 0 ? truth.base : truth.robots[robot - 1].base;
  }

  /// After `contacts` and the docks were read; `before` [s] is the beginning of the step.
  void read_motion(double before) noexcept {
    contact_friction.for_each([this](int geom1, int geom2, const Vector3& force, const Vector3& at) {
      if (owner_of(geom1).touches) add_push(owner_of(geom1), -force, at);
      if (owner_of(geom2).touches) add_push(owner_of(geom2), force, at);
    });
    for (std::size_t r = 0; r < robots.size(); ++r)
      watches[r].read_motion(robots[r], *model, *data, contacts.of_robot(r), before, time(), base_truth(r));
  }

  void look_for_falls() noexcept {
    for (std::size_t r = 0; r < robots.size(); ++r)
      BaseWatch::look_for_fall(robots[r], *model, *data, contacts.of_robot(r), time(), base_truth(r));
  }

  void add_push(const GeomOwner& owner, const Vector3& force, const Vector3& at) noexcept {
    contacts.add_push(static_cast<std::size_t>(owner.robot), force.head<2>(), at.head<2>());
  }

  /// Counted: MuJoCo's own clock adds up its steps and with them their rounding.
  double time() const { return static_cast<double>(steps_since_start) * model->opt.timestep; }

  PlantStatus give(std::size_t robot, const Eigen::VectorXd& tau) noexcept {
    if (diverged) return PlantStatus::diverged;
    return robots[robot].give(*data, tau, model->opt.timestep) ? PlantStatus::ok : PlantStatus::unreachable;
  }

  PlantStatus apply(const Eigen::VectorXd& tau) noexcept {
    if (const PlantStatus given = give(0, tau); given != PlantStatus::ok) return given;
    const double before = time();
    if (!step()) {
      diverged = true;
      return PlantStatus::diverged;
    }
    ++steps_since_start;
    const Vector3 now = first().planar_twist(*model, *data);
    truth.acceleration = (now - velocity) / model->opt.timestep;
    truth.velocity = velocity = now;
    read_base();
    for (MovingRobot& robot : robots) robot.read(*model, *data);
    contacts.read(*model, *data, before, truth);
    read_objects();
    read_pulls();
    feel_hand();
    read_motion(before);
    look_for_falls();
    latch_hooks();
    return PlantStatus::ok;
  }

  PlantStatus sense(std::size_t robot, Sensed& sensed) const noexcept {
    if (diverged) return PlantStatus::diverged;
    if (sensed.state.q.size() != robots[robot].joint_count()) return PlantStatus::unreachable;
    sensed.time = time();
    robots[robot].sense(*model, *data, sensed.state);
    sensed.base_measured = true;
    return PlantStatus::ok;
  }

  /// The force of the hand goes into the step, behind the friction of contacts, and to the sum of all
  /// contacts.
  void press_by_hand() noexcept {
    if (!push.force.isZero(0.0)) first().press(*model, *data, push.at, push.force);
  }
  void feel_hand() noexcept {
    if (push.force.isZero(0.0)) return;
    const Vector3 at = first().in_world(*model, *data, push.at);
    contacts.add_push(0, push.force, at.head<2>());
  }

  std::vector<MovingRobot> robots;  ///< the first, then the scene's
  std::string text;
  ModelPointer model;
  DataPointer data;
  ContactReader contacts;
  ContactFriction contact_friction;
  std::vector<BaseWatch> watches;  ///< by robot
  std::vector<SimulatedObject> objects;
  std::vector<SimulatedDock> docks;
  Vector3 velocity = Vector3::Zero();
  Push push;
  Truth truth;
  std::int64_t steps_since_start = 0;
  bool diverged = false;
};

MujocoPlant::MujocoPlant(const lang::Robot& robot, const lang::Scene& scene,
                         const MujocoPlantOptions& options)
    : simulation_(std::make_unique<Simulation>(robot, scene, options)) {}

MujocoPlant::~MujocoPlant() = default;

std::string describe_fall(const BaseTruth& base) {
  constexpr double degree = std::numbers::pi / 180.0;
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "fell over: roll %.0f deg, pitch %.0f deg", base.roll / degree,
                base.pitch / degree);
  return text.data();
}

PlantStatus MujocoPlant::sense(Sensed& sensed) noexcept {
  return simulation_->sense(0, sensed);
}

PlantStatus MujocoPlant::apply(const Eigen::VectorXd& tau) noexcept {
  return simulation_->apply(tau);
}

PlantStatus MujocoPlant::sense_partner(std::size_t partner, Sensed& sensed) const noexcept {
  return simulation_->sense(partner + 1, sensed);
}

PlantStatus MujocoPlant::give_partner(std::size_t partner, const Eigen::VectorXd& tau) noexcept {
  return simulation_->give(partner + 1, tau);
}

const Truth& MujocoPlant::truth() const noexcept {
  return simulation_->truth;
}

void MujocoPlant::set_push(const Push& push) noexcept {
  simulation_->push = push;
}

void MujocoPlant::set_floor_friction(double coefficient) noexcept {
  simulation_->set_floor_friction(coefficient);
}

void MujocoPlant::set_payload(double mass) noexcept {
  simulation_->first().set_payload(*simulation_->model, mass);
}

void MujocoPlant::set_partner_payload(std::size_t partner, double mass) noexcept {
  if (partner + 1 < simulation_->robots.size())
    simulation_->robots[partner + 1].set_payload(*simulation_->model, mass);
}

void MujocoPlant::set_wheel_friction(std::size_t robot, std::size_t wheel, double coefficient) noexcept {
  if (robot < simulation_->robots.size()) simulation_->set_wheel_friction(robot, wheel, coefficient);
}

void MujocoPlant::shift_centre_of_mass(std::size_t robot, double ahead) noexcept {
  if (robot < simulation_->robots.size())
    simulation_->robots[robot].shift_centre_of_mass(*simulation_->model, ahead);
}

void MujocoPlant::scale_inertia(std::size_t robot, double factor) noexcept {
  if (robot < simulation_->robots.size())
    simulation_->robots[robot].scale_inertia(*simulation_->model, factor);
}

void MujocoPlant::diverge() noexcept {
  simulation_->diverged = true;
}

const std::string& MujocoPlant::mjcf() const noexcept {
  return simulation_->text;
}

}  // namespace zwang::runtime
