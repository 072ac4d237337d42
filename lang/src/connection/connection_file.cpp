#include "connection/connection_file.hpp"

#include <algorithm>
#include <span>

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_connection.hpp"
#include "spec/shape.hpp"

namespace zwang::lang {

namespace {

constexpr double default_joints_age = 100e-3;  // [s]
constexpr int highest_domain = 232;            // its ports end below 65536
constexpr int highest_priority = 98;

constexpr MessageType signal_types[] = {MessageType::boolean, MessageType::float64, MessageType::pose_stamped,
                                        MessageType::wrench_stamped, MessageType::laser_scan};
constexpr MessageType output_types[] = {MessageType::boolean, MessageType::float64};

/// `geometry_msgs/msg/Twist` is the same type as `geometry_msgs/Twist`.
std::string without_msg(const std::string& type) {
  const std::size_t at = type.find("/msg/");
  return at == std::string::npos ? type : type.substr(0, at) + type.substr(at + 4);
}

template <typename Types>
std::optional<MessageType> parse_type(const Node& node, const std::string& what, const Types& types,
                                      Diagnostics& diagnostics) {
  const Word word = parse_word(node, what, diagnostics);
  if (!word.exists()) return std::nullopt;
  std::vector<std::string> names;
  for (const MessageType type : types) {
    names.push_back(to_string(type));
    if (names.back() == without_msg(word.text)) return type;
  }
  diagnostics.add(wording::unknown_name(word.span, "message type here", word.text, names));
  return std::nullopt;
}

std::string parse_choice(const Node& node, const std::string& what, const std::vector<std::string>& words,
                         Diagnostics& diagnostics) {
  const Word word = parse_word(node, what, diagnostics);
  if (!word.exists() || std::find(words.begin(), words.end(), word.text) != words.end()) return word.text;
  diagnostics.add(wording::unknown_name(word.span, "word for " + what, word.text, words));
  return "";
}

Topic parse_topic(MapReader& map, Diagnostics& diagnostics) {
  const Node* node = map.required("topic");
  if (node == nullptr) return {};
  const Word word = parse_word(*node, map.what() + "'s `topic`", diagnostics);
  if (word.exists() && !is_topic_name(word.text)) diagnostics.add(wording::bad_topic(word.span, word.text));
  return {word.text, node->span};
}

/// `{topic: /odom}`, with an example of it for whoever writes `/odom` alone.
Topic parse_topic_alone(const Node& node, const std::string& what, Diagnostics& diagnostics) {
  MapReader map(node, what, diagnostics, "{topic: " + (node.is_scalar() ? node.text : "/odom") + "}");
  Topic topic = parse_topic(map, diagnostics);
  map.finish();
  return topic;
}

/// `loopback`, `machine`, `network` or `[eth0]`.
void parse_reach(const Node& node, Connection& connection, Diagnostics& diagnostics) {
  if (node.is_sequence()) {
    connection.reach = Reach::network;
    for (const Node& item : node.items) {
      const Word name = parse_word(item, "an interface of `reach`", diagnostics);
      if (name.exists()) connection.interfaces.push_back(name.text);
    }
    if (node.items.empty()) diagnostics.add(wording::reach_of_nothing(node.span));
    return;
  }
  const std::string word = parse_choice(node, "`reach`", {"loopback", "machine", "network"}, diagnostics);
  if (word == "machine") connection.reach = Reach::machine;
  if (word == "network") connection.reach = Reach::network;
}

void parse_ros2(const Node& node, Connection& connection, Diagnostics& diagnostics) {
  MapReader map(node, "`ros2`", diagnostics);
  if (const Node* domain = map.optional("domain"))
    connection.domain =
        parse_integer(*domain, "`domain`", 0, highest_domain, diagnostics).value_or(connection.domain);
  if (const Node* reach = map.optional("reach")) {
    parse_reach(*reach, connection, diagnostics);
  }
  if (const Node* name = map.optional("name")) {
    const Word word = parse_word(*name, "`name`", diagnostics);
    if (word.exists() && !is_topic_name(word.text)) diagnostics.add(wording::bad_topic(word.span, word.text));
    if (word.exists()) connection.name = word.text;
  }
  map.finish();
}

JointsSource parse_joints(const Node& node, Diagnostics& diagnostics) {
  JointsSource joints;
  joints.stale_after = default_joints_age;
  MapReader map(node, "`joints`", diagnostics,
                "{topic: " + (node.is_scalar() ? node.text : "/joint_states") + "}");
  joints.topic = parse_topic(map, diagnostics);
  if (const Node* age = map.optional("stale_after")) {
    joints.stale_span = age->span;
    joints.stale_after = parse_positive(*age, dimension::time, "joints.stale_after", false, diagnostics)
                             .value_or(default_joints_age);
    if (joints.stale_after > given_up_after)
      diagnostics.add(wording::stale_too_late(age->span, joints.stale_after));
  }
  if (const Node* names = map.optional("names");
      names != nullptr && require_mapping(*names, "`names`", diagnostics)) {
    for (const Entry& entry : names->entries) {
      if (entry.key.is_bad) continue;
      const Word name = parse_word(entry.value, "names." + entry.key.text, diagnostics);
      for (const auto& [joint, other] : joints.names) {
        if (name.exists() && other == name.text)
          diagnostics.add(wording::name_twice(name.span, name.text, joints.name_spans[joint]));
      }
      joints.names[entry.key.text] = name.text;
      joints.name_spans[entry.key.text] = entry.key.span;
    }
  }
  map.finish();
  return joints;
}

FramePair parse_frames(const Node& node, const std::string& example, Diagnostics& diagnostics) {
  FramePair frames{"", "", node.span};
  MapReader map(node, "`tf`", diagnostics, example);
  if (const Node* parent = map.required("parent"))
    frames.parent = parse_word(*parent, "`parent`", diagnostics).text;
  if (const Node* child = map.required("child"))
    frames.child = parse_word(*child, "`child`", diagnostics).text;
  map.finish();
  if (!frames.parent.empty() && frames.parent == frames.child)
    diagnostics.add(wording::frame_in_itself(frames.span, frames.child));
  return frames;
}

/// `{topic: /amcl_pose}` or `{tf: {parent: map, child: base_link}}`.
void parse_fix(const Node& node, Connection& connection, Diagnostics& diagnostics) {
  MapReader map(node, "`fix`", diagnostics, "{topic: " + (node.is_scalar() ? node.text : "/amcl_pose") + "}");
  const Node* tf = map.optional("tf");
  if (tf == nullptr) {
    connection.fix = parse_topic(map, diagnostics);
  } else {
    if (map.optional("topic") != nullptr) diagnostics.add(wording::two_fixes(node.span));
    connection.fix_frames = parse_frames(*tf, "{parent: map, child: base_link}", diagnostics);
  }
  map.finish();
}

void parse_state(const Node& node, Connection& connection, Diagnostics& diagnostics) {
  MapReader map(node, "`state`", diagnostics, "{joints: {topic: /joint_states}}");
  if (const Node* joints = map.required("joints")) connection.joints = parse_joints(*joints, diagnostics);
  if (const Node* base = map.optional("base"))
    connection.base = parse_topic_alone(*base, "`base`", diagnostics);
  if (const Node* fix = map.optional("fix")) parse_fix(*fix, connection, diagnostics);
  if (const Node* wrench = map.optional("wrench"))
    connection.wrench = parse_topic_alone(*wrench, "`wrench`", diagnostics);
  map.finish();
}

/// `topic` and `type` of a signal or an output.
template <typename Carried>
void parse_message(MapReader& map, std::span<const MessageType> types, Carried& carried,
                   Diagnostics& diagnostics) {
  carried.topic = parse_topic(map, diagnostics);
  if (const Node* type = map.required("type"))
    carried.type = parse_type(*type, map.what() + "'s `type`", types, diagnostics).value_or(carried.type);
}

SignalSource parse_signal(const Entry& entry, Diagnostics& diagnostics) {
  SignalSource signal;
  signal.name = entry.key.text;
  signal.span = entry.key.span;
  MapReader map(entry.value, "signal `" + signal.name + "`", diagnostics,
                "{topic: /" + signal.name + ", type: std_msgs/Bool}");
  parse_message(map, signal_types, signal, diagnostics);
  const Node* nearest = map.optional("nearest");
  if (nearest != nullptr) {
    const auto range =
        parse_vector(*nearest, dimension::angle, 2, 2, map.what() + "'s `nearest`", diagnostics);
    if (range) signal.nearest = {(*range)[0], (*range)[1]};
    if (range && (*range)[0] >= (*range)[1]) diagnostics.add(wording::nearest_of_nothing(nearest->span));
  }
  const bool is_scan = signal.type == MessageType::laser_scan;
  if (map.is_mapping() && is_scan != (nearest != nullptr) && !map.has_misspelt({"nearest", "type"}))
    diagnostics.add(wording::nearest_of_a_scan(nearest != nullptr ? nearest->span : signal.span, is_scan));
  map.finish();
  return signal;
}

OutputSink parse_output(const Entry& entry, Diagnostics& diagnostics) {
  OutputSink output;
  output.name = entry.key.text;
  output.span = entry.key.span;
  MapReader map(entry.value, "output `" + output.name + "`", diagnostics,
                "{topic: /" + output.name + ", type: std_msgs/Bool}");
  parse_message(map, output_types, output, diagnostics);
  map.finish();
  return output;
}

/// `system` or `{ros: /clock}`.
void parse_clock(const Node& node, Connection& connection, Diagnostics& diagnostics) {
  if (node.is_scalar()) {
    parse_choice(node, "`clock`", {"system"}, diagnostics);
    return;
  }
  MapReader map(node, "`clock`", diagnostics, "{ros: /clock}");
  if (const Node* ros = map.required("ros")) {
    const Word word = parse_word(*ros, "`ros`", diagnostics);
    if (word.exists() && !is_topic_name(word.text)) diagnostics.add(wording::bad_topic(word.span, word.text));
    connection.clock = Topic{word.text, ros->span};
  }
  map.finish();
}

/// `{odometry: {topic: /zwang/odom}, tf: {parent: odom, child: base_link}, rate: 50 Hz}`.
void parse_publication(const Node& node, Connection& connection, Diagnostics& diagnostics) {
  MapReader map(node, "`publish`", diagnostics, "{odometry: {topic: /zwang/odom}}");
  BasePublication& publication = connection.publication.emplace();
  if (const Node* odometry = map.optional("odometry"))
    publication.odometry = parse_topic_alone(*odometry, "`odometry`", diagnostics);
  if (const Node* tf = map.optional("tf"))
    publication.frames = parse_frames(*tf, "{parent: odom, child: base_link}", diagnostics);
  if (const Node* rate = map.optional("rate"))
    publication.rate =
        parse_positive(*rate, dimension::frequency, "`rate`", false, diagnostics).value_or(publication.rate);
  map.finish();
  const auto& fix = connection.fix_frames;
  if (publication.frames && fix && fix->child == publication.frames->child)
    diagnostics.add(wording::told_and_heard(publication.frames->span, fix->child, fix->span));
}

void parse_timeout(MapReader& map, CommandSink& command, Diagnostics& diagnostics) {
  const Node* timeout = map.optional("timeout");
  if (timeout == nullptr) return;
  command.timeout_span = timeout->span;
  command.timeout = parse_positive(*timeout, dimension::time, "`timeout`", false, diagnostics);
  if (command.timeout.value_or(0.0) > given_up_after)
    diagnostics.add(wording::stopped_too_late(timeout->span, *command.timeout));
}

void parse_twist_sink(const Node& node, CommandSink& command, Diagnostics& diagnostics) {
  MapReader map(node, "`twist`", diagnostics, "{topic: /cmd_vel, type: geometry_msgs/Twist}");
  command.topic = parse_topic(map, diagnostics);
  constexpr MessageType types[] = {MessageType::twist, MessageType::twist_stamped};
  if (const Node* type = map.required("type"))
    command.type = parse_type(*type, "`type`", types, diagnostics).value_or(command.type);
  if (const Node* rate = map.optional("rate")) {
    command.rate_span = rate->span;
    command.rate = parse_positive(*rate, dimension::frequency, "`rate`", false, diagnostics);
  }
  parse_timeout(map, command, diagnostics);
  map.finish();
}

void parse_joints_sink(const Node& node, CommandSink& command, Diagnostics& diagnostics) {
  MapReader map(node, "`joints`", diagnostics,
                "{topic: /effort_controller/commands, what: effort, order: [left_wheel, right_wheel]}");
  command.type = MessageType::float64_multi_array;
  command.kind = CommandKind::effort;
  command.topic = parse_topic(map, diagnostics);
  if (const Node* what = map.required("what")) {
    if (parse_choice(*what, "`what`", {"effort", "velocity"}, diagnostics) == "velocity")
      command.kind = CommandKind::velocity;
  }
  const Node* order = map.required("order");
  if (order != nullptr && require_sequence(*order, "`order`", diagnostics)) {
    for (const Node& item : order->items) {
      command.order.push_back(parse_word(item, "a joint of `order`", diagnostics).text);
      command.order_spans.push_back(item.span);
    }
  }
  parse_timeout(map, command, diagnostics);
  map.finish();
}

CommandSink parse_command(const Node& node, Diagnostics& diagnostics) {
  CommandSink command;
  command.span = node.span;
  MapReader map(node, "`command`", diagnostics, "{twist: {topic: /cmd_vel, type: geometry_msgs/Twist}}");
  const Node* twist = map.optional("twist");
  const Node* joints = map.optional("joints");
  if (twist != nullptr) parse_twist_sink(*twist, command, diagnostics);
  if (joints != nullptr && twist == nullptr) parse_joints_sink(*joints, command, diagnostics);
  const bool is_one = (twist != nullptr) != (joints != nullptr);
  if (map.is_mapping() && !is_one && (twist != nullptr || !map.has_unread_keys()))
    diagnostics.add(wording::one_command(node.span));
  const Node* sink = twist != nullptr ? twist : joints;
  if (is_one && sink->is_mapping() && sink->find("timeout") == nullptr)
    diagnostics.add(wording::nothing_stops_it(command.topic.span, command.topic.name));
  map.finish();
  return command;
}

/// `at_once`, `wait` or `goals`, and what goals can name.
void parse_begin(MapReader& map, const std::filesystem::path& folder, Connection& connection,
                 Diagnostics& diagnostics) {
  if (const Node* start = map.optional("start")) {
    const std::string word = parse_choice(*start, "`start`", {"at_once", "wait", "goals"}, diagnostics);
    if (word == "wait") connection.begin = Begin::service;
    if (word == "goals") connection.begin = Begin::goals;
  }
  const Node* tasks = map.optional("tasks");
  if (tasks == nullptr || !require_mapping(*tasks, "`tasks`", diagnostics)) return;
  for (const Entry& entry : tasks->entries) {
    if (entry.key.is_bad) continue;
    const Word file = parse_word(entry.value, "tasks." + entry.key.text, diagnostics);
    if (!file.exists()) continue;
    connection.tasks.push_back({entry.key.text, folder / file.text, entry.key.span});
    std::error_code error;
    if (!std::filesystem::exists(folder / file.text, error))
      diagnostics.add(wording::unreadable_file(file.span, file.text, "no such file"));
  }
  if (connection.begin != Begin::goals && !map.has_misspelt({"start"}))
    diagnostics.add(wording::tasks_without_goals(tasks->span));
}

}  // namespace

std::optional<Connection> parse_connection(const Document& document, const std::filesystem::path& folder,
                                           Diagnostics& diagnostics) {
  MapReader map(document.root, "a connection file", diagnostics);
  if (!map.is_mapping() || !check_version(map, "zwang_connection", 1, diagnostics)) return std::nullopt;
  Connection connection;
  if (const Node* ros2 = map.optional("ros2")) parse_ros2(*ros2, connection, diagnostics);
  if (const Node* loop = map.optional("loop")) {
    MapReader loop_map(*loop, "`loop`", diagnostics);
    if (const Node* priority = loop_map.optional("priority"))
      connection.priority =
          parse_integer(*priority, "`priority`", 0, highest_priority, diagnostics).value_or(0);
    loop_map.finish();
  }
  if (const Node* state = map.required("state")) parse_state(*state, connection, diagnostics);
  const Node* signals = map.optional("signals");
  if (signals != nullptr && require_mapping(*signals, "`signals`", diagnostics)) {
    for (const Entry& entry : signals->entries) {
      if (!entry.key.is_bad) connection.signals.push_back(parse_signal(entry, diagnostics));
    }
  }
  const Node* outputs = map.optional("outputs");
  if (outputs != nullptr && require_mapping(*outputs, "`outputs`", diagnostics)) {
    for (const Entry& entry : outputs->entries) {
      if (!entry.key.is_bad) connection.outputs.push_back(parse_output(entry, diagnostics));
    }
  }
  if (const Node* clock = map.optional("clock")) parse_clock(*clock, connection, diagnostics);
  if (const Node* publish = map.optional("publish")) parse_publication(*publish, connection, diagnostics);
  if (const Node* command = map.required("command"))
    connection.command = parse_command(*command, diagnostics);
  parse_begin(map, folder, connection, diagnostics);  // last: `state` is no misspelt `start`
  map.finish();
  return connection;
}

}  // namespace zwang::lang
