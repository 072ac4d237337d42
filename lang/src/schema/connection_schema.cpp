#include "schema/parts.hpp"

namespace zwang::lang::schema {

namespace {

Json topic(const char* description) {
  return object(description, {{"topic", word("a ROS 2 topic, with its namespace"), true}});
}

Json whole_number(int least, int most, const char* description) {
  return {{"type", "integer"}, {"minimum", least}, {"maximum", most}, {"description", description}};
}

Json timeout() {
  return reference("quantity", "after such a silence the receiver stops the motors by itself");
}

Json joints_source() {
  return object(
      "sensor_msgs/JointState",
      {{"topic", word("a ROS 2 topic, with its namespace"), true},
       {"stale_after", reference("quantity", "without a new sample the robot is stopped; default 100 ms")},
       {"names", named("the URDF's joints that have other names in the messages", word("the name there"))}});
}

Json wrench_source() {
  return object("what presses on a robot that `feels` by a wrench, in the axes of the sensor's frame",
                {{"topic", word("a topic of geometry_msgs/WrenchStamped"), true}});
}

Json fix_source() {
  const Json frames = object("of transforms on /tf and /tf_static",
                             {{"parent", word("as map"), true}, {"child", word("as base_link"), true}});
  return object("the base's pose, now and then: one of the two",
                {{"topic", word("a topic of geometry_msgs/PoseWithCovarianceStamped")}, {"tf", frames}});
}

/// ROS 2 itself prints `std_msgs/msg/Bool`, which is the same type as `std_msgs/Bool`.
Json message_type(const char* description, std::vector<std::string> types) {
  std::string pattern;
  for (const std::string& type : types) {
    const std::size_t slash = type.find('/');
    pattern += (pattern.empty() ? "^(" : "|") + type.substr(0, slash) + "/msg" + type.substr(slash);
  }
  Json schema =
      any_of({one_of_words("", std::move(types)), Json{{"type", "string"}, {"pattern", pattern + ")$"}}});
  schema["description"] = description;
  return schema;
}

Json signal() {
  return object(
      "", {{"topic", word("a ROS 2 topic, with its namespace"), true},
           {"type",
            message_type("the message, which gives the signal's type",
                         {"std_msgs/Bool", "std_msgs/Float64", "geometry_msgs/PoseStamped",
                          "geometry_msgs/WrenchStamped", "sensor_msgs/LaserScan"}),
            true},
           {"nearest", reference("vector", "of a LaserScan: the angles between which a range counts")}});
}

Json output() {
  return object(
      "", {{"topic", word("a ROS 2 topic, with its namespace"), true},
           {"type", message_type("a number is sent in SI", {"std_msgs/Bool", "std_msgs/Float64"}), true}});
}

Json clock() {
  return any_of({one_of_words("default: this computer's", {"system"}),
                 object("a simulation's", {{"ros", word("a topic of rosgraph_msgs/Clock"), true}})});
}

Json reach() {
  Json schema = any_of({one_of_words("", {"loopback", "machine", "network"}),
                        filled(list("interfaces of the robot's network, as eth0", word("")))});
  schema["description"] = "default loopback";
  return schema;
}

Json publication() {
  const Json frames = object("a transform on /tf",
                             {{"parent", word("as odom"), true}, {"child", word("as base_link"), true}});
  return object("what others are told of the base", {{"odometry", topic("nav_msgs/Odometry")},
                                                     {"tf", frames},
                                                     {"rate", reference("quantity", "default 50 Hz")}});
}

Json command() {
  const Json twist = object(
      "", {{"topic", word(""), true},
           {"type",
            message_type("as the receiver reads it", {"geometry_msgs/Twist", "geometry_msgs/TwistStamped"}),
            true},
           {"rate", reference("quantity", "default: once a control period")},
           {"timeout", timeout()}});
  const Json joints =
      object("std_msgs/Float64MultiArray", {{"topic", word(""), true},
                                            {"what", one_of_words("", {"effort", "velocity"}), true},
                                            {"order", list("every joint with a motor", word("")), true},
                                            {"timeout", timeout()}});
  return object("one of the two", {{"twist", twist}, {"joints", joints}});
}

}  // namespace

Json connection_file() {
  return object(
      "The ROS 2 topics over which a robot is sensed and commanded",
      {version("zwang_connection"),
       {"ros2", object("", {{"domain", whole_number(0, 232, "ROS_DOMAIN_ID; default 0")},
                            {"reach", reach()},
                            {"name", word("before the names of the own services; default `/zwang`")}})},
       {"start", one_of_words("default at_once; wait: for the service `start`; goals: of the action `run`",
                              {"at_once", "wait", "goals"})},
       {"tasks", named("what a goal of the action `run` can name", word("a task file"))},
       {"loop",
        object("", {{"priority", whole_number(0, 98, "of SCHED_FIFO; default 0, the usual scheduler")}})},
       {"state",
        object("", {{"joints", joints_source(), true},
                    {"base", topic("nav_msgs/Odometry; without it the wheels tell how the base moves")},
                    {"fix", fix_source()},
                    {"wrench", wrench_source()}}),
        true},
       {"clock", clock()},
       {"publish", publication()},
       {"signals", named("the sources of the task's signals", signal())},
       {"outputs", named("where the task's outputs go", output())},
       {"command", command(), true}});
}

}  // namespace zwang::lang::schema
