#include "words/nearest.hpp"

#include <algorithm>

#include "words/text.hpp"

namespace zwang::lang {

int edit_distance(std::string_view a, std::string_view b) {
  // A common start and a common end cost nothing.
  const auto begin = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  a.remove_prefix(static_cast<std::size_t>(begin.first - a.begin()));
  b.remove_prefix(static_cast<std::size_t>(begin.second - b.begin()));
  const auto end = std::mismatch(a.rbegin(), a.rend(), b.rbegin(), b.rend());
  a.remove_suffix(static_cast<std::size_t>(end.first - a.rbegin()));
  b.remove_suffix(static_cast<std::size_t>(end.second - b.rbegin()));
  const std::size_t columns = b.size() + 1;
  std::vector<int> before_last(columns), last(columns), row(columns);
  for (std::size_t j = 0; j < columns; ++j) last[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j < columns; ++j) {
      const int change = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, change});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  if (word.size() > 64) return {};
  std::string best;
  int best_distance = static_cast<int>(word.size()) / 3 + 1;
  if (word.size() <= 1) best_distance = 0;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > 64) continue;
    if (candidate != word && lower_case(candidate) == lower_case(word)) return candidate;
    const int distance = edit_distance(word, candidate);
    // Nothing of the word would be left: no suggestion.
    if (distance >= static_cast<int>(std::max(word.size(), candidate.size()))) continue;
    if (distance < best_distance || (distance == best_distance && best.empty())) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

namespace {

struct Synonym {
  std::string_view word, key;
};

/// Words that authors bring from other programs.
constexpr Synonym synonyms[] = {
    {"frame", "move"},
    {"link", "move"},
    {"body", "move"},
    {"reference", "in"},
    {"relative_to", "in"},
    {"wrt", "in"},
    {"axes", "in"},
    {"frame", "in"},
    {"frame", "parent"},
    {"default", "value"},
    {"min", "range"},
    {"max", "range"},
    {"limits", "range"},
    {"description", "about"},
    {"description", "help"},
    {"comment", "note"},
    {"timeout", "stale_after"},
    {"max_age", "stale_after"},
    {"if", "when"},
    {"condition", "when"},
    {"until", "when"},
    {"then", "goto"},
    {"next", "goto"},
    {"to", "goto"},
    {"target", "goto"},
    {"duration", "for"},
    {"duration", "after"},
    {"hold", "for"},
    {"position", "at"},
    {"pos", "at"},
    {"xy", "at"},
    {"x", "at"},
    {"y", "at"},
    {"rotation", "yaw"},
    {"orientation", "yaw"},
    {"heading", "yaw"},
    {"angle", "yaw"},
    {"yaw", "rz"},
    {"theta", "rz"},
    {"heading", "rz"},
    {"roll", "rx"},
    {"pitch", "ry"},
    {"max_force", "force"},
    {"torque", "force"},
    {"effort", "force"},
    {"tau", "time_constant"},
    {"k", "stiffness"},
    {"d", "damping"},
    {"priority", "level"},
    {"return_speed", "return"},
    {"recovery", "return"},
    {"distance", "position"},
    {"distance", "distance_to"},
    {"pose", "pose_of"},
    {"states", "tasks"},
    {"initial", "start"},
    {"start", "start_at"},
    {"timeout", "time_limit"},
    {"gear_ratio", "gear"},
    {"kp", "stiffness"},
    {"kd", "damping"},
    {"kv", "damping"},
    {"time", "at"},
    {"parameters", "params"},
    {"variables", "params"},
    {"world", "scene"},
    {"cells", "matrix"},
    {"expectations", "expect"},
    {"assert", "expect"},
    {"speed", "velocity"},
    {"args", "with"},
    {"arguments", "with"},
    {"template", "use"},
    {"region", "inside"},
    {"area", "inside"},
    {"zone", "inside"},
    {"retries", "attempts"},
    {"rectangle", "polygon"},
    {"lower", "range"},
    {"upper", "range"},
    {"center", "at"},
    {"centre", "at"},
    {"z", "at"},
    {"xyz", "at"},
    {"translation", "at"},
    {"frame_id", "parent"},
    {"wz", "rz"},
    {"omega", "rz"},
    {"transitions", "exits"},
    {"outcomes", "exits"},
    {"tasks", "constraints"},
    {"robot_description", "urdf"},
    {"base_link", "base"},
    {"base_frame", "base"},
    {"robot_base_frame", "base"},
    {"motors", "actuated"},
    {"actuators", "actuated"},
    {"joints", "actuated"},
    {"name", "joint"},
    {"obstacles", "objects"},
    {"static", "fixed"},
    {"mu", "friction"},
    {"t", "time"},
    {"yaw", "start_yaw"},
    {"success", "done"},
    {"succeeded", "done"},
    {"end", "done"},
    {"exit", "done"},
    {"finish", "done"},
    {"finished", "done"},
    {"failure", "failed"},
    {"abort", "failed"},
    {"aborted", "failed"},
    {"error", "failed"},
    {"box", "polygon"},
    {"on_enter", "enter"},
    {"on_entry", "enter"},
    {"entry", "enter"},
    {"enter_action", "enter"},
    {"initial_state", "start"},
    {"initial_task", "start"},
    {"entry_point", "start"},
    {"start_task", "start"},
    {"sequence", "tasks"},
    {"behavior_tree", "tasks"},
    {"steps", "tasks"},
    {"nodes", "tasks"},
    {"actions", "tasks"},
    {"event", "when"},
    {"trigger", "when"},
    {"guard", "when"},
    {"cond", "when"},
    {"transition", "goto"},
    {"next_state", "goto"},
    {"next_task", "goto"},
    {"target_state", "goto"},
    {"set_frame", "set"},
    {"assign", "set"},
    {"debounce", "for"},
    {"dwell", "for"},
    {"stable_for", "for"},
    {"hysteresis", "release"},
    {"reference_frame", "in"},
    {"ref_frame", "in"},
    {"ref", "in"},
    {"frame_id", "in"},
    {"root", "in"},
    {"root_link", "in"},
    {"tip", "move"},
    {"tip_link", "move"},
    {"end_effector", "move"},
    {"ee_link", "move"},
    {"child_frame", "move"},
    {"target_velocity", "velocity"},
    {"desired_velocity", "velocity"},
    {"target_position", "position"},
    {"desired_position", "position"},
    {"target_force", "force"},
    {"desired_force", "force"},
    {"inflation_radius", "margin"},
    {"inflation", "margin"},
    {"padding", "margin"},
    {"clearance", "margin"},
    {"subtree", "use"},
    {"include", "use"},
    {"extends", "use"},
    {"retry", "attempts"},
    {"max_retries", "attempts"},
    {"num_retries", "attempts"},
    {"number_of_retries", "attempts"},
    {"base_frame_id", "base"},
    {"root_link", "base"},
    {"wheel_radius", "radius"},
    {"roller_angle", "roller"},
    {"joint_name", "joint"},
    {"reduction", "gear"},
    {"mechanical_reduction", "gear"},
    {"ratio", "gear"},
    {"armature", "rotor_inertia"},
    {"inertia", "rotor_inertia"},
    {"static", "coulomb"},
    {"static_friction", "coulomb"},
    {"dynamic", "viscous"},
    {"update_rate", "control_period"},
    {"control_frequency", "control_period"},
    {"rate", "control_period"},
    {"dt", "control_period"},
    {"timestep", "control_period"},
    {"encoder_resolution", "encoder_step"},
    {"ticks_per_rev", "encoder_step"},
    {"counts_per_revolution", "encoder_step"},
    {"home", "posture"},
    {"initial_positions", "posture"},
    {"frequency", "rate"},
    {"update_rate", "rate"},
    {"latency", "delay"},
    {"stddev", "noise"},
    {"sigma", "noise"},
    {"dropout", "dropouts"},
    {"range_to", "distance_to"},
    {"contact", "latch"},
    {"attached", "latch"},
    {"touching", "latch"},
    {"tolerance", "reach"},
    {"trajectory", "motion"},
    {"path", "motion"},
    {"waypoints", "motion"},
    {"pose", "at"},
    {"location", "at"},
    {"initial_pose", "start"},
    {"spawn", "start"},
    {"motor", "wheel"},
    {"joint", "wheel"},
    {"result", "outcome"},
    {"status", "outcome"},
    {"after", "of"},
    {"since", "of"},
    {"from", "of"},
    {"check", "that"},
    {"condition", "that"},
    {"theta", "yaw"},
    {"contact", "touched"},
    {"velocity", "speed"},
};

bool holds(const std::vector<std::string>& keys, std::string_view key) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

}  // namespace

std::string meant_key(std::string_view word, const std::vector<std::string>& keys) {
  for (const Synonym& synonym : synonyms) {
    if (synonym.word == word && holds(keys, synonym.key)) return std::string(synonym.key);
  }
  std::string meant = nearest(word, keys);
  if (!meant.empty() || word.size() < 3) return meant;
  for (const std::string& key : keys) {
    if (!key.starts_with(word)) continue;
    if (!meant.empty()) return {};
    meant = key;
  }
  return meant;
}

}  // namespace zwang::lang
