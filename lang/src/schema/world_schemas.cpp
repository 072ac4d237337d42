// Robot, scene and scenario files.
#include "schema/parts.hpp"

namespace zwang::lang::schema {

namespace {

Json wheel() {
  return object("", {{"joint", word("the joint that it turns on"), true},
                     {"radius", reference("quantity"), true},
                     {"roller", reference("quantity",
                                          "mecanum and omni: from the wheel's axis to the roller's at "
                                          "the ground, about the base's +z")},
                     {"holds", list("what a plain wheel holds; both when absent",
                                    one_of_words("", {"rolling", "sideways"}))}});
}

Json base_ranges(const char* description) {
  return object(description,
                {{"x", reference("range")}, {"y", reference("range")}, {"rz", reference("range")}});
}

Json robot_frame() {
  return object("", {{"parent", word("a link, or an earlier frame"), true},
                     {"at", reference("vector", "the origin, in the parent")},
                     {"yaw", reference("quantity")},
                     {"rpy", tuple("roll, pitch and yaw", reference("quantity"), 3, 3)}});
}

Json actuator() {
  return object("",
                {{"effort", reference("quantity", "largest torque on the joint's side; default the URDF's")},
                 {"slew", reference("quantity", "how fast it may change; default all of it within 5 ms")},
                 {"gear", reference("quantity", "turns of the motor for one of the joint")},
                 {"rotor_inertia", reference("quantity", "of the rotor alone, before the gear")}});
}

Json joint_friction() {
  return object(
      "", {{"coulomb", reference("quantity", "dry friction")},
           {"presliding", reference("quantity", "angle or length that the joint gives before it slides")},
           {"viscous", reference("quantity", "friction that grows with the speed")},
           {"compensate", reference("quantity", "the part that the controller makes up for")}});
}

Json shape_sizes() {
  return {{"box", tuple("three lengths", reference("quantity"), 3, 3)},
          {"cylinder", object("", {{"radius", reference("quantity")}, {"height", reference("quantity")}})},
          {"wall", object("", {{"length", reference("quantity")},
                               {"thickness", reference("quantity")},
                               {"height", reference("quantity")}})}};
}

Json motion_point() {
  return object("", {{"time", reference("quantity"), true},
                     {"at", reference("point"), true},
                     {"yaw", reference("quantity")}});
}

Json dock() {
  return object("a socket that a hook latches in", {{"at", reference("point", "in the object's axes"), true},
                                                    {"reach", reference("quantity")},
                                                    {"hook", word("a frame of the robot"), true}});
}

Json scene_object() {
  Json sizes = shape_sizes();
  return object("has one shape: box, cylinder or wall",
                {{"box", sizes["box"]},
                 {"cylinder", sizes["cylinder"]},
                 {"wall", sizes["wall"]},
                 {"at", reference("point", "in the world; of a wall, a point of its face"), true},
                 {"yaw", reference("quantity")},
                 {"mass", reference("quantity", "of what can be pushed")},
                 {"fixed", Json{{"type", "boolean"}}},
                 {"stiffness", reference("quantity", "of a contact, as N/m")},
                 {"damping", reference("quantity", "of a contact, against the critical one")},
                 {"friction", reference("quantity", "coefficient")},
                 {"motion", filled(list("what it follows, whatever stands in its way", motion_point()))},
                 {"dock", dock()}});
}

Json scene_signal() {
  return object("has one source: script, pose_of, distance_to, latch or force_of",
                {{"script", filled(list("pairs of a time and a value", Json{{"type", "array"}}))},
                 {"pose_of", word("an object or a robot; `base` is the first one")},
                 {"distance_to", word("an object or a robot")},
                 {"latch", word("an object or a robot with a dock")},
                 {"force_of", word("an object or a robot that the first one touches")},
                 {"noise", reference("quantity", "standard deviation")},
                 {"bias", reference("quantity", "of a force: how much too large it is measured")},
                 {"angle_noise", reference("quantity", "standard deviation")},
                 {"delay", reference("quantity")},
                 {"rate", reference("quantity")},
                 {"dropouts", reference("quantity", "the part that never arrives")}});
}

Json fix() {
  return object("a pose of the base that somebody measures now and then",
                {{"noise", reference("quantity", "standard deviation")},
                 {"angle_noise", reference("quantity", "standard deviation")},
                 {"delay", reference("quantity")},
                 {"rate", reference("quantity")},
                 {"dropouts", reference("quantity", "the part that never arrives")}});
}

Json base_state() {
  return any_of({one_of_words("", {"perfect", "wheels"}),
                 object("standard deviations", {{"position", reference("quantity")},
                                                {"yaw", reference("quantity")},
                                                {"velocity", reference("quantity")},
                                                {"turn", reference("quantity")},
                                                {"delay", reference("quantity", "of whole samples")}}),
                 object("told by the wheels, and corrected", {{"fix", fix(), true}})});
}

Json scene_robot() {
  return object("another robot, under a task file of its own",
                {{"task", word("its task file, seen from this one"), true},
                 {"robot", word("in the place of the task's own")},
                 {"params", named("values for its task", reference("quantity"))},
                 {"at", reference("point", "where its base starts, in the world"), true},
                 {"yaw", reference("quantity")},
                 {"stiffness", reference("quantity", "of a contact, as N/m")},
                 {"damping", reference("quantity", "of a contact, against the critical one")},
                 {"friction", reference("quantity", "coefficient")},
                 {"dock", dock()},
                 {"signals", named("where its task's signals come from", scene_signal())},
                 {"state", base_state()}});
}

Json fault() {
  return object(
      "one thing that goes wrong",
      {{"at", reference("quantity", "when it begins"), true},
       {"for", reference("quantity", "to the end when absent")},
       {"samples", one_of_words("", {"lost", "nan", "inf", "huge", "frozen", "dead"})},
       {"clock", one_of_words("", {"backwards", "ahead"})},
       {"robot", word("one of `robots`; the first one when absent")},
       {"wheel", word("a joint with a motor; of `floor_friction`, any wheel's")},
       {"torque", one_of_words("", {"lost", "stuck", "flipped"})},
       {"floor_friction", reference("quantity")},
       {"payload", reference("quantity", "of the base; negative: lighter")},
       {"centre_of_mass", reference("quantity", "of the base: how much farther ahead it lies")},
       {"inertia", reference("quantity", "of the base: as a share of its own how much more it has")},
       {"plant", one_of_words("", {"diverges"})}});
}

Json start_pose() {
  return object("where the robot stands", {{"at", reference("point")}, {"yaw", reference("quantity")}});
}

Json expectation() {
  const Json condition = word("a condition; truth.* is what the plant measured");
  return any_of({object("", {{"outcome",
                              one_of_words("", {"done", "failed", "stopped", "fallen", "diverged", "refused",
                                                "unfinished"}),
                              true},
                             {"of", word("a robot of the scene; the first one's when absent")}}),
                 object("", {{"diagnostic", word("the code that the task is refused with"), true}}),
                 object("", {{"at", one_of_words("", {"end"}), true}, {"that", condition, true}}),
                 object("", {{"within", reference("quantity"), true},
                             {"of", word("what starts the time; the run's start when absent")},
                             {"that", condition, true}}),
                 object("", {{"always", condition, true}})});
}

}  // namespace

Json robot_file() {
  return object(
      "What a URDF cannot say of a robot",
      {version("zwang_robot"),
       {"urdf", word("seen from this file"), true},
       {"base", word("the link that floats"), true},
       {"wheels", list("the drive follows from them", wheel()), true},
       {"supports", list("links that stand on the ground and hold nothing", word("a link"))},
       {"actuated", named("motors by their joints", actuator()), true},
       {"limits", object("of the base, where a task gives none",
                         {{"acceleration", base_ranges("")}, {"velocity", base_ranges("")}})},
       {"stop",
        object("the one brake",
               {{"deceleration", reference("quantity"), true}, {"force", reference("quantity"), true}}),
        true},
       {"posture", named("where joints stand at the start", reference("quantity"))},
       {"friction", named("by joint", joint_friction())},
       {"footprint",
        object("the outline on the floor, in the base frame", {{"polygon", reference("polygon"), true}}),
        true},
       {"bumper", object("", {{"stiffness", reference("quantity")}, {"height", reference("quantity")}})},
       {"control_period", reference("quantity")},
       {"frames", named("places on the robot", robot_frame())}});
}

Json scene_file() {
  return object("What stands around a simulated robot",
                {version("zwang_scene"),
                 {"start", start_pose()},
                 {"floor", object("", {{"friction", reference("quantity")}})},
                 {"real_rollers",
                  Json{{"type", "boolean"}, {"description", "mecanum and omni wheels roller by roller"}}},
                 {"objects", named("what the robot can meet", scene_object())},
                 {"robots", named("other robots, with tasks of their own", scene_robot())},
                 {"signals", named("where the task's signals come from", scene_signal())},
                 {"state", base_state()},
                 {"faults", list("what goes wrong, and when", fault())}});
}

Json scenario_file() {
  const Json one_or_more = any_of({word(""), list("", word(""))});
  return object("A claim about a task, and how to test it",
                {version("zwang_scenario"),
                 {"about", word("what it is for")},
                 {"task", word("the task file, seen from this one"), true},
                 {"time_limit", reference("quantity", "a longer run is unfinished")},
                 {"seed", Json{{"type", "integer"}, {"minimum", 0}}},
                 {"blend", reference("quantity", "in the place of that of every task")},
                 {"scene", word("in the place of the task's own")},
                 {"robot", word("in the place of the task's own")},
                 {"params", named("values for this scenario", reference("quantity"))},
                 {"start_at", reference("point")},
                 {"start_yaw", reference("quantity")},
                 {"matrix", named("every combination is run: robot, start_at, start_yaw, params.NAME, faults",
                                  list("", Json::object()))},
                 {"faults", named("sets of faults, for the matrix", list("", fault()))},
                 {"expect", list("what must come true", expectation()), true}});
}

}  // namespace zwang::lang::schema
