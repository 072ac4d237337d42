#include "observe.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "../cli/interruption.hpp"
#include "arguments.hpp"
#include "base_way.hpp"
#include "task_run.hpp"

namespace zwang::connect {

namespace {

constexpr double has_turned = 0.05;  // [rad] or [m]: enough to judge a sign by

/// Of a joint: how far its positions say that it went, and how far its rates do. [rad] or [m]
struct Way {
  double by_positions = 0.0, by_rates = 0.0, length = 0.0;
  double least_step =
      std::numeric_limits<double>::infinity();  ///< from a sample to the next one that differs
};

/// False where the rates contradict the positions.
bool print_joint(const std::string& name, const Way& way) {
  const char* verdict = "has not moved: turn it by hand and look again";
  bool is_good = true;
  if (way.length > has_turned) {
    is_good = std::abs(way.by_rates - way.by_positions) < 0.3 * way.length;
    verdict = is_good                                 ? "positions and rates agree"
              : way.by_rates * way.by_positions < 0.0 ? "its rate has the other sign than its position"
                                                      : "its rate is not that of its position: another unit?";
  }
  std::printf("  %-24s moved %7.3f, by its rates %7.3f: %s\n", name.c_str(), way.by_positions, way.by_rates,
              verdict);
  if (way.length > has_turned)
    std::printf("  %-24s least step %.2g: `encoder_step` of the robot file\n", "", way.least_step);
  return is_good;
}

}  // namespace

void print_topics(const Inbox& inbox) {
  for (const auto& c : inbox.counts()) {
    const auto received = static_cast<double>(c->received.load());
    const double span = c->last_arrival - c->first_arrival;
    std::printf("%s (%s): %.0f received, %llu bad", c->topic.c_str(), c->type, received,
                static_cast<unsigned long long>(c->bad.load()));
    if (received > 1.0 && span > 0.0)
      std::printf(", %.1f Hz, age mean %.2f, most %.2f ms", (received - 1.0) / span,
                  1e3 * c->age_sum / received, 1e3 * c->most_age);
    const auto others = static_cast<unsigned long long>(c->others.load());
    if (others > 0) std::printf(", %llu of another publisher not taken", others);
    std::printf("\n");
  }
}

int observe(const lang::Connection& connection, const lang::Program& program, Inbox& inbox, double seconds) {
  const solver::Model& model = program.robot.model;
  std::vector<Way> ways(static_cast<std::size_t>(model.joint_count()));
  runtime::Sensed sensed(program);
  std::optional<JointsSample> before;
  BaseWay base_way;
  for (const double until = now() + seconds; now() < until && !cli::is_interrupted();) {
    if (!inbox.wait_for_joints(now() + 0.1)) continue;
    inbox.fill(sensed);
    const JointsSample& sample = inbox.joints();
    for (std::size_t j = 0; before && j < ways.size(); ++j) {
      const auto i = static_cast<Eigen::Index>(j);
      const double step = sample.q(i) - before->q(i), dt = sample.stamp - before->stamp;
      ways[j].by_positions += step;
      ways[j].length += std::abs(step);
      if (step != 0.0) ways[j].least_step = std::min(ways[j].least_step, std::abs(step));
      ways[j].by_rates += 0.5 * (sample.qd(i) + before->qd(i)) * dt;
    }
    base_way.look(inbox.base());
    before = sample;
  }
  print_topics(inbox);
  bool is_good = inbox.has_joints() && inbox.has_base() && inbox.has_wrench();
  if (!inbox.has_joints()) {
    std::printf("no sample of every motor's joint has come on %s in domain %d\n",
                connection.joints.topic.name.c_str(), connection.domain);
    return exit_bad;
  }
  // `zwang drive` would not begin.
  if (const std::string trouble = clock_trouble(connection, program, inbox); !trouble.empty()) {
    std::printf("%s\n", trouble.c_str());
    is_good = false;
  }
  for (std::size_t j = 0; j < ways.size(); ++j)
    is_good = print_joint(model.joint(static_cast<int>(j)).name, ways[j]) && is_good;
  if (const auto way = base_way.way())
    std::printf("  the base went %.3f m ahead, %.3f m to its left\n", way->x(), way->y());
  for (const auto& c : inbox.counts()) {
    const bool has_come = c->received > 0 || c->may_be_silent;
    is_good = is_good && has_come && c->bad == 0 && c->others == 0;
  }
  std::fflush(stdout);
  return is_good ? exit_good : exit_bad;
}

}  // namespace zwang::connect
