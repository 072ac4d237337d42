#include "contact_reader.hpp"

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace zwang::runtime {

namespace {

constexpr double shortest_hit = 0.02;  ///< [s] the window of QuietMeans

/// A spring that closes or opens at v swings by v sqrt(K m) about its rest. Beyond this the step is a hit's.
double largest_swing(double force) {
  constexpr double least = 2.0;   // [N]
  constexpr double share = 0.05;  // of the force itself
  return std::max(least, share * force);
}

}  // namespace

ContactReader::ContactReader(std::vector<GeomOwner> owners, std::vector<ContactSpring> springs,
                             const std::vector<SimulatedRobot>& robots, std::size_t objects)
    : owners_(std::move(owners)),
      springs_(std::move(springs)),
      robots_(robots.size()),
      met_(objects + robots.size()),
      objects_(objects) {
  for (std::size_t r = 0; r < robots.size(); ++r)
    robots_[r].on_body.resize(static_cast<std::size_t>(robots[r].robot.model.body_count()));
}

void ContactReader::add_push(std::size_t robot, int body, const Eigen::Vector3d& force,
                             const Eigen::Vector3d& at, const Eigen::Vector3d& torque) noexcept {
  RobotContacts& of = robots_[robot];
  of.push += force.head<2>();
  of.moment += at.x() * force.y() - at.y() * force.x() + torque.z();
  of.on_body[static_cast<std::size_t>(body)] += solver::ForceVector{at.cross(force) + torque, force};
}

/// The object that the first robot's outline touches in this contact: an index into the truth's objects, or
/// -1.
int ContactReader::touched_object(int geom1, int geom2) const noexcept {
  const GeomOwner &one = owner_of(geom1), &other = owner_of(geom2);
  const bool first_is_one = one.touches && one.robot == 0;
  if (!first_is_one && !(other.touches && other.robot == 0)) return -1;
  const GeomOwner& met = first_is_one ? other : one;
  return met.touches ? static_cast<int>(objects_) + met.robot - 1 : met.object;
}

const ContactSpring* ContactReader::spring_of(const mjModel& model, int geom1, int geom2) const noexcept {
  for (int p = 0; p < model.npair; ++p) {
    if (std::minmax(model.pair_geom1[p], model.pair_geom2[p]) == std::minmax(geom1, geom2))
      return &springs_[static_cast<std::size_t>(p)];
  }
  return nullptr;
}

void ContactReader::read(const mjModel& model, const mjData& data, double before, Truth& truth) noexcept {
  for (ObjectTruth& object : truth.objects) object.force = 0.0;
  std::ranges::fill(met_, Met{});
  std::fill(truth.corner_forces.begin(), truth.corner_forces.end(), 0.0);
  for (RobotContacts& robot : robots_) {
    robot.push.setZero();
    robot.moment = 0.0;
    std::fill(robot.on_body.begin(), robot.on_body.end(), solver::ForceVector{});
    robot.lies_on_floor = false;
  }
  for (int c = 0; c < data.ncon; ++c) {
    const mjContact& contact = data.contact[c];
    const GeomOwner &one = owner_of(contact.geom1), &other = owner_of(contact.geom2);
    for (const GeomOwner* owner : {&one, &other}) {
      if (owner->body) robots_[static_cast<std::size_t>(owner->robot)].lies_on_floor = true;
    }
    if (!one.touches && !other.touches) continue;
    if (one.is_floor() || other.is_floor() || contact.efc_address < 0) continue;
    std::array<mjtNum, 6> wrench{};
    mj_contactForce(&model, &data, c, wrench.data());
    const double force = wrench[0];
    const ContactSpring* spring = spring_of(model, contact.geom1, contact.geom2);
    const double swing = std::abs(data.efc_vel[contact.efc_address]) * spring->impedance();
    for (const auto& [owner, sign] : {std::pair(&one, -1.0), std::pair(&other, 1.0)}) {
      if (!owner->touches) continue;
      RobotContacts& robot = robots_[static_cast<std::size_t>(owner->robot)];
      add_push(static_cast<std::size_t>(owner->robot), owner->part, sign * force * vector_of(contact.frame),
               vector_of(contact.pos));
      if (swing > largest_swing(force))
        robot.hit_until = std::max(robot.hit_until, before + std::max(shortest_hit, spring->half_swing()));
      if (owner->robot == 0 && owner->corner >= 0)
        truth.corner_forces[static_cast<std::size_t>(owner->corner)] += force;
    }
    const int k = touched_object(contact.geom1, contact.geom2);
    if (k < 0) continue;
    ObjectTruth& object = truth.objects[static_cast<std::size_t>(k)];
    object.force += force;
    if (!object.touched) object.touched = before;
    const bool is_first_one = one.touches && one.robot == 0;
    Met& met = met_[static_cast<std::size_t>(k)];
    met.push += (is_first_one ? -force : force) * vector_of(contact.frame);
    met.body = (is_first_one ? one : other).part;
  }
  keep_peaks(truth);
}

void ContactReader::keep_peaks(Truth& truth) const noexcept {
  for (std::size_t k = 0; k < truth.objects.size(); ++k) {
    ObjectTruth& object = truth.objects[k];
    if (!(object.force > object.peak_force)) continue;
    object.peak_force = object.force;
    object.peak_push = met_[k].push;
    object.peak_body = met_[k].body;
  }
}

void ContactReader::note_catch(std::size_t robot, double time) noexcept {
  robots_[robot].hit_until = std::max(robots_[robot].hit_until, time + shortest_hit);
}

}  // namespace zwang::runtime
