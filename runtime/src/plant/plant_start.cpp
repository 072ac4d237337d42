// How the simulation comes to stand where the scene says. MuJoCo's model is written and read, and its parts
// are found. The robots settle on the floor in plant_settle.cpp.
#include <mujoco/mujoco.h>

#include <cstdio>
#include <cstring>
#include <utility>

#include "plant_simulation.hpp"
#include "refuse.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::runtime {

namespace {

constexpr double start_overlap = 1e-5;  ///< [m] allowed between robot and objects at the start

std::string numbered(const char* name, int number) {
  return std::string(name) + '_' + std::to_string(number);
}

}  // namespace

MujocoPlant::Simulation::Simulation(const lang::Robot& robot, const lang::Scene& scene,
                                    const MujocoPlantOptions& options) {
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
  contacts =
      ContactReader(owners, set_springs(*model, owners, scene, described), described, scene.objects.size());
  contact_friction = ContactFriction(*model, owners);
  for (const MovingRobot& one : robots) watches.emplace_back(one, options.period);
  truth.corner_forces.assign(robot.footprint.size(), 0.0);
  for (const lang::SceneObject& object : scene.objects) truth.objects.push_back({object.name, 0.0, {}, 0.0});
  for (const lang::SceneRobot& other : scene.robots) {
    truth.objects.push_back({other.name, 0.0, {}, 0.0});
    truth.robots.emplace_back();
  }
  find_objects(scene);
  find_docks(scene);
  find_sensors(scene);
  std::vector<Start> starts{
      {options.start_at.value_or(scene.start_at), options.start_yaw.value_or(scene.start_yaw)}};
  for (const lang::SceneRobot& other : scene.robots) starts.push_back({other.at, other.yaw});
  start(starts);
}

std::vector<SimulatedRobot> MujocoPlant::Simulation::describe_robots(const lang::Robot& robot,
                                                                     const lang::Scene& scene,
                                                                     bool real_rollers) {
  std::vector<SimulatedRobot> described{prepare_robot(robot, real_rollers)};
  for (std::size_t r = 0; r < scene.robots.size(); ++r) {
    const auto& program = scene.robots[r].program;
    if (!program) refuse("the task file of the robot `" + scene.robots[r].name + "` was not loaded");
    described.push_back(prepare_robot(program->robot, real_rollers, static_cast<int>(r) + 1));
  }
  return described;
}

int MujocoPlant::Simulation::id_of(int type, const std::string& name) const {
  return mj_name2id(model.get(), type, name.c_str());
}

void MujocoPlant::Simulation::find_addresses() {
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

void MujocoPlant::Simulation::find_objects(const lang::Scene& scene) {
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
    const int guide = id_of(mjOBJ_JOINT, name + "_guide");
    if (guide >= 0) {
      simulated_object.position = model->jnt_qposadr[guide];
      simulated_object.velocity = model->jnt_dofadr[guide];
      simulated_object.guide.emplace(*object.guide, model->dof_M0[simulated_object.velocity]);
    } else if (joint >= 0 && object.mass) {
      add_floor(scene.floor_friction, simulated_object);
    }
    objects.push_back(std::move(simulated_object));
  }
}

void MujocoPlant::Simulation::add_floor(double friction, SimulatedObject& object) const {
  const double gravity = first().model().gravity().norm();
  if (object.described.caster_trail > 0.0) {
    object.casters.emplace(casters_of(object.described, friction, gravity));
  } else {
    object.friction = floor_friction_of(object.described, friction, gravity);
  }
}

void MujocoPlant::Simulation::find_docks(const lang::Scene& scene) {
  const auto add = [&](std::size_t owner, const std::string& name, const lang::Dock& dock, int body) {
    const solver::Frame& hook = hook_of(first().model(), dock, name);
    docks.push_back({owner, dock, body, id_of(mjOBJ_EQUALITY, numbered("dock", static_cast<int>(owner))),
                     id_of(mjOBJ_BODY, numbered("body", hook.body)), hook.body, hook.pose_in_body.position});
  };
  for (std::size_t k = 0; k < objects.size(); ++k) {
    if (scene.objects[k].dock) add(k, scene.objects[k].name, *scene.objects[k].dock, objects[k].body);
  }
  for (std::size_t r = 0; r < scene.robots.size(); ++r) {
    const lang::SceneRobot& robot = scene.robots[r];
    if (robot.dock) add(objects.size() + r, robot.name, *robot.dock, robots[r + 1].base_body());
  }
}

void MujocoPlant::Simulation::find_sensors(const lang::Scene& scene) {
  for (std::size_t r = 0; r < robots.size(); ++r) {
    const solver::Model& described = robots[r].model();
    bodies.emplace_back();
    for (int b = 0; b < described.body_count(); ++b)
      bodies[r].push_back(
          id_of(mjOBJ_BODY, robots[r].simulated().named("body", static_cast<std::size_t>(b))));
    const std::vector<lang::SceneSignal>& signals = r == 0 ? scene.signals : scene.robots[r - 1].signals;
    truth.wrenches.emplace_back(signals.size());
    for (std::size_t i = 0; i < signals.size(); ++i) {
      if (signals[i].kind != lang::SceneSignalKind::wrench) continue;
      const auto frame = described.find_frame(signals[i].frame);
      if (!frame) refuse("the robot has no frame `" + signals[i].frame + "` for a sensor");
      const solver::Frame& at = described.frames()[static_cast<std::size_t>(*frame)];
      WrenchSensor sensor{r, i, bodies[r][static_cast<std::size_t>(at.body)], at.pose_in_body, {}};
      for (int b = 0; b < described.body_count(); ++b) {
        int carrier = b;
        while (carrier > at.body) carrier = described.bodies()[static_cast<std::size_t>(carrier)].parent;
        if (carrier == at.body) sensor.carried.push_back(static_cast<std::size_t>(b));
      }
      sensors.push_back(std::move(sensor));
    }
  }
}

void MujocoPlant::Simulation::start(const std::vector<Start>& starts) {
  for (std::size_t r = 0; r < robots.size(); ++r) robots[r].place(*model, *data, starts[r].at, starts[r].yaw);
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

void MujocoPlant::Simulation::refuse_overlap() const {
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

std::string MujocoPlant::Simulation::name_of(const GeomOwner& owner) const {
  if (owner.object < 0 && owner.robot == 0) return "the robot";
  const auto index = owner.object >= 0 ? static_cast<std::size_t>(owner.object)
                                       : objects.size() + static_cast<std::size_t>(owner.robot) - 1;
  return "`" + truth.objects[index].name + "`";
}

}  // namespace zwang::runtime
