// Hits of the plant: no contact gives back more than it took, and the forecast N603 is the plant's peak.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>
#include <random>
#include <sstream>

#include "../is_long.hpp"
#include "../temporary_folder.hpp"
#include "plant/contact_spring.hpp"
#include "plant_robots.hpp"
#include "zwang/lang/notes.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

using namespace testing;
namespace fs = std::filesystem;

lang::Scene wall_at(double x, double stiffness, double damping, double yaw = 0.0) {
  lang::SceneObject wall;
  wall.name = "wall";
  wall.shape = lang::ShapeKind::wall;
  wall.size = {6.0, 0.2, 1.0};
  wall.at = {x, 0.0};
  wall.yaw = yaw;
  wall.stiffness = stiffness;
  wall.damping = damping;
  lang::Scene scene;
  scene.objects = {wall};
  return scene;
}

/// The mass on the stepped spring, found at a depth of `found` h v: the speed at which it leaves, as a share.
double rebound(double stiffness_number, double ratio, double found, double mass_error) {
  const double h = 1e-3, mass = 10.0;
  const double stiffness = stiffness_number * mass / (h * h);
  const ContactSpring spring{stiffness, 2.0 * ratio * std::sqrt(stiffness * mass), mass};
  const SteppedSpring step = stepped(spring, mass_error / mass, h);
  double v = 1.0, x = found * h * v;
  for (int i = 0; i < 100000 && x > 0.0; ++i) {
    const double f = std::max(0.0, (step.stiffness * x + step.damping * v) / (1.0 + step.mass / mass));
    v -= h * f / mass;
    x += h * v;
  }
  return x > 0.0 ? 0.0 : std::abs(v);
}

// (h w)^2 from 1e-6 to 1e8, any depth at which the contact is found, an inverse mass that is four times
// wrong.
TEST(HitEnergy, NoStepGivesBackMoreThanItTook) {
  for (double number = 1e-6; number < 2e8; number *= 3.0) {
    for (const double ratio : {0.0, 0.05, 0.3, 0.7, 1.0, 2.0, 5.0}) {
      for (const double found : {0.05, 0.25, 0.5, 0.75, 1.0}) {
        for (const double error : {0.25, 1.0, 4.0})
          ASSERT_LE(rebound(number, ratio, found, error), 1.0 + 1e-9)
              << number << " " << ratio << " " << found << " " << error;
      }
    }
  }
}

/// Of the planar motion, wheels and rotors included: 1/2 v' M v, M from what unit wrenches do to the base at
/// rest.
double kinetic_energy(const PlanarReference& reference, const Vector3& velocity) {
  Matrix3 inverse;
  for (int i = 0; i < 3; ++i)
    inverse.col(i) = reference.acceleration(reference.torque_of_wrench(Vector3::Unit(i)), Vector3::Zero());
  return 0.5 * velocity.dot(inverse.inverse() * velocity);
}

// A base that coasts into a wall, square and askew, leaves it with no more energy.
TEST(HitEnergy, NoWallGivesBackMoreThanItTook) {
  for (const double stiffness : {1e5, 1e9, 1e12}) {
    for (const double damping : {0.0, 0.3}) {
      for (const double yaw : {0.0, 0.4}) {
        const lang::Robot robot = mecanum_base();
        const PlanarReference reference(robot.model);
        MujocoPlant plant(robot, wall_at(0.62, stiffness, damping, yaw));
        while (plant.truth().velocity.norm() < 0.2) {
          ASSERT_EQ(plant.apply(reference.torque({2.0, 0.0, 0.0}, plant.truth().velocity)), PlantStatus::ok);
        }
        const Eigen::VectorXd rest = Eigen::VectorXd::Zero(4);
        const double before = kinetic_energy(reference, plant.truth().velocity);
        double most = 0.0;
        const std::optional<double>& touched = plant.truth().objects[0].touched;
        while (!touched || plant.truth().time < *touched + 0.2) {
          ASSERT_EQ(plant.apply(rest), PlantStatus::ok);
          ASSERT_LT(plant.truth().time, 5.0);
          if (plant.truth().objects[0].touched)
            most = std::max(most, kinetic_energy(reference, plant.truth().velocity));
        }
        EXPECT_LE(most, 1.01 * before) << "K " << stiffness << " damping " << damping << " yaw " << yaw;
      }
    }
  }
}

/// The more slippery of a crate and the floor holds it: mu m g. A crate that says nothing has the floor's.
TEST(ObjectFriction, OfACrateAndTheFloorTheSmallerOneActs) {
  using Own = std::optional<double>;
  for (const auto& [own, floor, acts] :
       {std::tuple(Own(0.05), 0.9, 0.05), {Own(), 0.2, 0.2}, {Own(0.5), 0.1, 0.1}, {Own(0.0), 0.9, 0.0}}) {
    lang::SceneObject crate;
    crate.name = "crate";
    crate.shape = lang::ShapeKind::box;
    crate.size = {0.3, 0.6, 0.4};
    crate.at = {0.56, 0.0};
    crate.mass = 25.0;
    crate.friction = own;
    lang::Scene scene;
    scene.objects = {crate};
    scene.floor_friction = floor;
    MujocoPlant plant(mecanum_base(), scene);
    const PlanarReference reference(mecanum_base().model);
    double sum = 0.0;
    for (int i = 0; i < 3000; ++i) {
      const Truth& truth = plant.truth();
      const Vector3 demand(4.0 * (0.1 - truth.velocity.x()), -4.0 * truth.velocity.y() - 4.0 * truth.y,
                           -8.0 * truth.velocity.z() - 16.0 * truth.yaw);
      ASSERT_EQ(plant.apply(reference.torque(demand, truth.velocity) +
                            reference.torque_of_wrench({acts * 25.0 * 9.81, 0.0, 0.0})),
                PlantStatus::ok);
      if (i >= 2000) sum += plant.truth().objects[0].force / 1000.0;
    }
    EXPECT_GT(plant.truth().velocity.x(), 0.05) << "it slides";
    EXPECT_NEAR(sum, acts * 25.0 * 9.81, std::max(0.05, 0.01 * acts * 25.0 * 9.81));
  }
}

/// `peaks near 332 N`, `1.2 kN`
double forecast_of(const lang::Diagnostics& diagnostics) {
  for (const lang::Diagnostic& d : diagnostics.all()) {
    if (d.code != "N603") continue;
    const std::size_t at = d.message.find("peaks near ");
    return std::stod(d.message.substr(at + 11));
  }
  return 0.0;
}

// Drivers without a velocity range, from rest: what the way to the wall makes of them, or the robot's limits.
TEST(HitForecast, WithoutARangeIsThePlantsPeakWithinAQuarter) {
  const std::vector<const char*> drivers = {"in: base_link, x: {force: 30 N}",
                                            "in: base_link, x: {acceleration: 0.3 m/s^2}",
                                            "in: world, x: {position: 2 m}"};
  const std::size_t count = test::is_long() ? drivers.size() : 1;
  for (std::size_t i = 0; i < count; ++i) {
    const zwang::test::TemporaryFolder temporary;
    const fs::path& folder = temporary.path();
    for (const char* name : {"mecanum_base.yaml", "mecanum_base.urdf"})
      fs::copy_file(fs::path(ZWANG_SOURCE_DIR "/specs/robots") / name, folder / name);
    std::ofstream(folder / "scene.yaml") << "zwang_scene: 1\nstart: {at: [0 m, 0 m], yaw: 0 deg}\nobjects:\n "
                                            " o: {box: [0.2 m, 1 m, 0.5 m], at: "
                                            "[1.2 m, 0 m], fixed: true, stiffness: 50 kN/m, damping: 0.1}\n";
    std::ofstream(folder / "task.yaml")
        << "zwang: 1\nrobot: mecanum_base.yaml\nscene: scene.yaml\nstart: go\ntasks:\n  go:\n    "
           "constraints:\n      a: {move: base_link, "
        << drivers[i]
        << ", y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}\n    timeout: {after: 9 s, goto: done}\n";
    lang::Diagnostics diagnostics;
    const auto program = lang::load_with_notes(folder / "task.yaml", {}, diagnostics);
    ASSERT_TRUE(program);
    const double forecast = forecast_of(diagnostics);
    ScenePlant plant(*program);
    Runner runner(*program);
    Sensed sensed(program->robot.model, program->signals.size());
    while (plant.truth().time < 5.0 && (!plant.truth().objects[0].touched ||
                                        plant.truth().time < *plant.truth().objects[0].touched + 0.2)) {
      ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
      ASSERT_EQ(plant.apply(runner.step(sensed)), PlantStatus::ok);
    }
    const double peak = plant.truth().objects[0].peak_force;
    EXPECT_NEAR(forecast, peak, 0.25 * peak) << drivers[i];
  }
}

// Square hits of shipped bases at drawn speeds, springs and force ranges.
TEST(HitForecast, IsThePlantsPeakWithinAQuarter) {
  std::mt19937 random(603);
  const auto between = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const char* const robots[] = {"mecanum_base", "omni_base", "diff_base", "kelo_base"};
  const int hits = test::is_long() ? 200 : 8;
  double worst = 0.0;
  for (int i = 0; i < hits; ++i) {
    const std::string name = robots[i % 4];
    const double speed = between(0.05, 0.6), stiffness = std::pow(10.0, between(1.0, 3.0));  // [kN/m]
    const double damping = between(0.0, 1.0), bound = between(5.0, 40.0), tau = between(0.05, 0.4);
    // Until 1 % of the speed is missing: at 1 m/s^2 or the force range at most, with 120 kg.
    const double way = 15.0 * tau * speed + speed * speed * (1.0 + 120.0 / bound);
    const zwang::test::TemporaryFolder temporary;
    const fs::path& folder = temporary.path();
    for (const char* end : {".yaml", ".urdf"})
      fs::copy_file(fs::path(ZWANG_SOURCE_DIR "/specs/robots") / (name + end), folder / (name + end));
    std::ofstream(folder / "wall.yaml")
        << "zwang_scene: 1\nstart: {at: [0 m, 0 m], yaw: 0 deg}\nfloor: {friction: 0.9}\nobjects:\n"
        << "  wall: {wall: {length: 4 m, thickness: 0.1 m, height: 1 m}, at: [" << 0.5 + way
        << " m, 0 m], fixed: true, "
           "stiffness: "
        << stiffness << " kN/m, damping: " << damping << "}\n";
    const std::string range = i % 5 == 0 ? "" : ", force: +-" + std::to_string(bound) + " N";
    std::ofstream(folder / "task.yaml")
        << "zwang: 1\nrobot: " << name
        << ".yaml\nscene: wall.yaml\nstart: go\ntasks:\n  go:\n    constraints:\n"
        << "      a: {move: base_link, in: base_link, x: {velocity: " << speed << " m/s" << range
        << ", time_constant: " << tau << " s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}\n"
        << "    timeout: {after: 60 s, goto: done}\n";
    lang::Diagnostics diagnostics;
    const auto program = lang::load_with_notes(folder / "task.yaml", {}, diagnostics);
    std::ostringstream words;
    lang::render_human(diagnostics, words);
    ASSERT_TRUE(program) << words.str();
    const double forecast = forecast_of(diagnostics);
    if (forecast == 0.0 && !range.empty()) continue;  // gentle
    ScenePlant plant(*program);
    Runner runner(*program);
    Sensed sensed(program->robot.model, program->signals.size());
    double arrived = 0.0;
    while (plant.truth().time < 60.0 && (!plant.truth().objects[0].touched ||
                                         plant.truth().time < *plant.truth().objects[0].touched + 0.3)) {
      ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
      if (!plant.truth().objects[0].touched) arrived = plant.truth().velocity.x();
      ASSERT_EQ(plant.apply(runner.step(sensed)), PlantStatus::ok);
    }
    ASSERT_NEAR(arrived, speed, 0.02 * speed) << "it had the way to get as fast";
    const double peak = plant.truth().objects[0].peak_force;
    std::printf("%s: %.2f m/s, %.0f kN/m, damping %.2f, %s: %.0f N of %.0f N forecast\n", name.c_str(), speed,
                stiffness, damping, range.c_str(), peak, forecast);
    worst = std::max(worst, std::abs(forecast / peak - 1.0));
    EXPECT_NEAR(forecast, peak, 0.25 * peak);
  }
  std::printf("worst %.3f\n", worst);
}

}  // namespace
}  // namespace zwang::runtime
