// Robot, scene and scenario files.
#include "schema/parts.hpp"

namespace zwang::lang::schema {

namespace {

Json wheel() {
  return object(
      "",
      {{"joint", word("the joint that the wheel turns on"), true},
       {"radius", reference("quantity", "from the axle to the ground; of a driven one also in `each_wheel`")},
       {"roller", reference("quantity",
                            "mecanum and omni: from the wheel's axis to the roller's at "
                            "the ground, about the base's +z")},
       {"drop", reference("quantity", "that it stands lower than the URDF draws it")},
       {"holds", list("the directions that a plain wheel holds; default both",
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
  return object(
      "", {{"effort", reference("quantity", "largest torque on the joint's side; default the URDF's")},
           {"slew", reference("quantity", "how fast the torque may change; default all of it within 5 ms")},
           {"gear", reference("quantity", "turns of the motor for one of the joint")},
           {"rotor_inertia", reference("quantity", "the inertia of the rotor alone, before the gear")}});
}

Json each_wheel() {
  return object(
      "of every wheel with a motor that says nothing itself",
      {{"kind", one_of_words("what the wheels are; default plain", {"plain", "skid", "mecanum"})},
       {"radius", reference("quantity", "from the axle to the ground")},
       {"effort", reference("quantity", "largest torque on the joint's side; default the URDF's")},
       {"gear", reference("quantity", "turns of the motor for one of the joint")},
       {"rotor_inertia", reference("quantity", "the inertia of the rotor alone, before the gear")},
       {"mass", reference("quantity", "of a wheel under `inertias` to which the URDF gives none")}});
}

Json each_joint() {
  return object(
      "of every motor that turns no wheel, where neither its own entry nor the URDF says it",
      {{"effort", reference("quantity", "largest torque or force on the joint's side")},
       {"gear", reference("quantity", "turns of the motor for one of the joint")},
       {"rotor_inertia", reference("quantity", "the inertia of the rotor alone, before the gear")}});
}

Json link_inertia() {
  return object("a solid disc of a wheel, else a solid ball",
                {{"mass", reference("quantity", "default the URDF's")},
                 {"radius", reference("quantity", "default the wheel's")},
                 {"at", reference("vector", "the centre of mass, in the link's axes; default the URDF's")}});
}

Json drive() {
  return object("what the motors' drive takes; default torques",
                {{"command", one_of_words("", {"torque", "velocity"}), true},
                 {"as", one_of_words("what is told: wheels or the base", {"wheels", "twist"})},
                 {"rate", reference("quantity", "of commands and samples, 20 Hz at least")},
                 {"delay", reference("quantity", "encoder to runtime to wheel, 50 ms at most")},
                 {"time_constant", reference("quantity", "of the wheels' velocity loops")},
                 {"integral_time", any_of({one_of_words("the loops have no integral", {"none"}),
                                           reference("quantity", "of the loops")})},
                 {"torque_limit",
                  one_of_words("sent with each command, or the drive's own", {"each_cycle", "fixed"})}});
}

Json feels() {
  return object(
      "what tells of contacts, where the drive has torque limits of its own; default nothing",
      {{"wrench", object("a sensor of forces and torques between the base and the world",
                         {{"frame", word("fixed to the base: its axes and its origin"), true},
                          {"noise", reference("quantity", "a force, standard deviation"), true},
                          {"filter", reference("quantity", "time constant of its low pass"), true}})},
       {"effort", object("the torques of the wheels' motors",
                         {{"noise", reference("quantity", "a torque, standard deviation"), true},
                          {"resolution", reference("quantity", "a torque, the least step")},
                          {"filter", reference("quantity", "time constant of its low pass"), true}})}});
}

Json joint_friction() {
  return object(
      "", {{"coulomb", reference("quantity", "dry friction")},
           {"presliding", reference("quantity", "the angle or length that the joint gives before it slides")},
           {"viscous", reference("quantity", "friction that grows with the speed")},
           {"compensate", reference("quantity", "the share that the controller gives back, below 100 %")}});
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
  return object("a socket in which a hook latches", {{"at", reference("point", "in the object's axes"), true},
                                                     {"reach", reference("quantity")},
                                                     {"hook", word("a frame of the robot"), true},
                                                     {"press", reference("quantity",
                                                                         "a force: it latches what "
                                                                         "presses so hard")},
                                                     {"held_while", word("an output of the task file: it "
                                                                         "holds while that is true")}});
}

std::vector<Property> guide_of(const char* travel, std::vector<Property> first) {
  first.insert(first.end(), {{"range", reference("range", travel), true},
                             {"preload", reference("quantity", "presses towards 0")},
                             {"stiffness", reference("quantity", "of a spring that is relaxed at 0")},
                             {"damping", reference("quantity")},
                             {"friction", reference("quantity", "dry, as a force or a torque")},
                             {"locked", Json{{"type", "boolean"}}}});
  return first;
}

Json scene_object() {
  Json sizes = shape_sizes();
  return object(
      "has one shape: box, cylinder or wall",
      {{"box", sizes["box"]},
       {"cylinder", sizes["cylinder"]},
       {"wall", sizes["wall"]},
       {"at", reference("point", "in the world; of a wall, a point of its face"), true},
       {"yaw", reference("quantity")},
       {"rpy", tuple("roll, pitch and yaw of a fixed box or wall that leans", reference("quantity"), 3, 3)},
       {"mass", reference("quantity", "of an object that a push moves")},
       {"fixed", Json{{"type", "boolean"}}},
       {"hinge", object("an upright axis that it turns about",
                        guide_of("angles that it turns through; it stands at 0",
                                 {{"at", reference("point", "in the object's axes"), true}}))},
       {"slide", object("a guide that it moves along",
                        guide_of("how far it moves; it stands at 0",
                                 {{"along", one_of_words("", {"x", "-x", "y", "-y"}), true}}))},
       {"slides",
        reference("quantity", "coefficient on the floor, in the place of its friction and the floor's")},
       {"casters", reference("quantity", "the trail of four swivel casters at its corners")},
       {"stiffness", reference("quantity", "of a contact, as N/m")},
       {"damping", reference("quantity", "of a contact, against the critical one")},
       {"friction", reference("quantity", "coefficient")},
       {"motion", filled(list("points in time that it follows, whatever stands in its way", motion_point()))},
       {"dock", dock()}});
}

Json scene_signal() {
  return object(
      "has one source: script, pose_of, distance_to, latch, force_of, travel_of or wrench_at",
      {{"script", filled(list("pairs of a time and a value", Json{{"type", "array"}}))},
       {"pose_of", word("an object or a robot; `base` is the first one")},
       {"distance_to", word("an object or a robot")},
       {"latch", word("an object or a robot with a dock")},
       {"force_of", word("an object or a robot that the first one touches")},
       {"travel_of", word("an object with a hinge or a slide")},
       {"wrench_at", word("a frame of the robot: a force-torque sensor sits there")},
       {"beyond",
        reference(
            "quantity",
            "of travel_of, force_of, wrench_at: true where the travel, or the force, is as far from 0")},
       {"noise", reference("quantity", "standard deviation")},
       {"bias", any_of({reference("quantity", "added to a force"),
                        tuple("added to a wrench, along the sensor's axes", reference("quantity"), 3, 3)})},
       {"angle_noise", reference("quantity", "standard deviation")},
       {"delay", reference("quantity")},
       {"rate", reference("quantity")},
       {"dropouts", reference("quantity", "the share that never arrives")}});
}

Json fix() {
  return object("a pose of the base that is measured now and then",
                {{"noise", reference("quantity", "standard deviation")},
                 {"angle_noise", reference("quantity", "standard deviation")},
                 {"delay", reference("quantity")},
                 {"rate", reference("quantity")},
                 {"dropouts", reference("quantity", "the share that never arrives")}});
}

Json base_state() {
  return any_of({one_of_words("", {"perfect", "wheels"}),
                 object("standard deviations", {{"position", reference("quantity")},
                                                {"yaw", reference("quantity")},
                                                {"velocity", reference("quantity")},
                                                {"turn", reference("quantity")},
                                                {"delay", reference("quantity", "of whole samples")}}),
                 object("reckoned from the wheels, and corrected", {{"fix", fix(), true}})});
}

Json scene_robot() {
  return object("another robot, under a task file of its own",
                {{"task", word("the path of its task file, from this file"), true},
                 {"robot", word("in the place of the task's own")},
                 {"params", named("values for its task", reference("quantity"))},
                 {"at", reference("point", "where its base starts, in the world"), true},
                 {"yaw", reference("quantity")},
                 {"stiffness", reference("quantity", "of a contact, as N/m")},
                 {"damping", reference("quantity", "of a contact, against the critical one")},
                 {"friction", reference("quantity", "coefficient")},
                 {"dock", dock()},
                 {"signals", named("the sources of its task's signals", scene_signal())},
                 {"state", base_state()}});
}

Json fault(bool of_run) {
  Json fault =
      object("one thing that goes wrong",
             {{"at", reference("quantity", "when the fault begins"), true},
              {"for", reference("quantity", "how long it lasts; default to the end")},
              {"samples", one_of_words("", {"lost", "nan", "inf", "huge", "frozen", "dead"})},
              {"clock", one_of_words("", {"backwards", "ahead"})},
              {"robot", word("one of `robots`; default the first robot")},
              {"wheel", word("a joint with a motor; of `floor_friction`, any wheel's")},
              {"torque", one_of_words("", {"lost", "stuck", "flipped"})},
              {"floor_friction", reference("quantity")},
              {"payload", reference("quantity", "of the base; negative: lighter")},
              {"centre_of_mass", reference("quantity", "of the base: how much farther ahead it lies")},
              {"inertia", reference("quantity", "of the base: as a share of its own how much more it has")},
              {"leaves", word("an object of the scene, that goes away")},
              {"plant", one_of_words("", {"diverges"})}});
  if (of_run)
    fault["properties"]["of"] = word("the time of the run from which `at` counts; default the start");
  return fault;
}

Json push() {
  return object("a person's hand for a while; `force`, `torque` or both",
                {{"at", reference("quantity", "when it begins"), true},
                 {"for", reference("quantity", "how long it lasts; default to the end")},
                 {"robot", word("one of `robots`; default the first robot")},
                 {"frame", word("of the robot, at whose origin it presses; default its base's")},
                 {"object", word("an object with a mass, pressed on in the place of a robot")},
                 {"point", reference("point", "of the object, in its axes from its `at`")},
                 {"force", tuple("in the axes of the frame or the object", reference("quantity"), 2, 3)},
                 {"torque", tuple("about the same axes", reference("quantity"), 3, 3)}});
}

Json start_pose() {
  return object("where the robot starts", {{"at", reference("point")}, {"yaw", reference("quantity")}});
}

/// Of a study it may say how sure it must be.
Json expectation(bool of_study = false) {
  const Json condition = word("a condition; truth.* is what the plant measured");
  Json choices = any_of(
      {object("", {{"outcome",
                    one_of_words(
                        "", {"done", "failed", "stopped", "fallen", "diverged", "refused", "unfinished"}),
                    true},
                   {"of", word("a robot of the scene; default the first robot")}}),
       object("", {{"diagnostic", word("the code with which the task is refused, or warned of"), true}}),
       object("", {{"at", one_of_words("", {"end"}), true}, {"that", condition, true}}),
       object("", {{"within", reference("quantity"), true},
                   {"of", word("the time from which it counts; default the start of the run")},
                   {"that", condition, true}}),
       object("", {{"always", condition, true}})});
  if (!of_study) return choices;
  for (Json& choice : choices["anyOf"]) {
    choice["properties"]["probability"] = certainty("the share of all runs in which it must hold");
    choice["properties"]["confidence"] = certainty("with which that must be shown; default 95 %");
  }
  return choices;
}

Json draw() {
  const Json number = reference("quantity");
  return object(
      "one distribution",
      {{"uniform", tuple("lowest and highest value", number, 2, 2)},
       {"log_uniform", tuple("lowest and highest value; evenly by its logarithm", number, 2, 2)},
       {"normal", tuple("mean and standard deviation", number, 2, 2)},
       {"choice", list("values, each as often as the others", Json::object())},
       {"times", Json{{"type", "boolean"}, {"description", "a factor on the value that is there"}}}});
}

}  // namespace

Json robot_file() {
  Json schema = object(
      "The part of a robot that a URDF cannot say",
      {version("zwang_robot"),
       {"based_on", word("the path of another robot file, from this file: it says what is not said here")},
       {"urdf", word("the path of the URDF, from this file")},
       {"base", word("the link that floats")},
       {"wheels", list("the wheels; the drive follows from them", wheel())},
       {"each_wheel", each_wheel()},
       {"each_joint", each_joint()},
       {"axes", named("axes of joints in their own frames, in the place of the URDF's",
                      tuple("x, y, z", Json{{"type", "number"}}, 3, 3))},
       {"inertias", named("bodies of links, in the place of the URDF's", link_inertia())},
       {"fixed", list("joints of the URDF that do not move here", word("a joint"))},
       {"turns", list("joints of the URDF that turn without end here", word("a joint"))},
       {"mimic",
        named("joints that follow another one by a <mimic> of the URDF",
              one_of_words("moves by itself, or is kept in step by the floor", {"ignore", "coupled"}))},
       {"ignore", list("links of the URDF that are left out, with all that hangs on them", word("a link"))},
       {"lead", word("the link or frame that tasks drive, if not the base")},
       {"supports", list("links that stand on the ground and hold nothing", word("a link"))},
       {"actuated", named("motors by their joints", actuator())},
       {"limits", object("ranges of the base, if a task gives none",
                         {{"acceleration", base_ranges("")}, {"velocity", base_ranges("")}})},
       {"stop",
        object("the brake of `done`, `failed` and the protective stop",
               {{"deceleration", reference("quantity"), true}, {"force", reference("quantity"), true}})},
       {"posture", named("where joints stand at the start", reference("quantity"))},
       {"friction", named("by joint", joint_friction())},
       {"footprint",
        object("the outline on the floor, in the base frame", {{"polygon", reference("polygon"), true}})},
       {"bumper", object("", {{"stiffness", reference("quantity")}, {"height", reference("quantity")}})},
       {"control_period", reference("quantity")},
       {"encoder_step",
        reference("quantity", "an angle: the least by which a driven wheel's position changes")},
       {"drive", drive()},
       {"feels", feels()},
       {"pads", named("flat ends of arms, by their frames",
                      tuple("the lengths along y and z of the frame", reference("quantity"), 2, 2))},
       {"frames", named("places on the robot", robot_frame())}});
  const Json whole = Json::array({"urdf", "base", "wheels", "actuated", "stop", "footprint"});
  schema["anyOf"] = Json::array({Json{{"required", Json::array({"based_on"})}}, Json{{"required", whole}}});
  return schema;
}

Json scene_file() {
  return object("The world around a simulated robot",
                {version("zwang_scene"),
                 {"start", start_pose()},
                 {"floor", object("", {{"friction", reference("quantity")}})},
                 {"real_rollers",
                  Json{{"type", "boolean"}, {"description", "mecanum and omni wheels roller by roller"}}},
                 {"objects", named("the things that the robot can meet", scene_object())},
                 {"robots", named("other robots, with tasks of their own", scene_robot())},
                 {"signals", named("the sources of the task's signals", scene_signal())},
                 {"state", base_state()},
                 {"faults", list("faults, and when they begin", fault(false))},
                 {"pushes", list("hands of persons on robots and objects", push())}});
}

Json scenario_file() {
  const Json one_or_more = any_of({word(""), list("", word(""))});
  return object("A claim about a task, and how to test it",
                {version("zwang_scenario"),
                 {"about", word("a sentence for reports")},
                 {"task", word("the path of the task file, from this file"), true},
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
                 {"faults", named("sets of faults, for the matrix", list("", fault(true)))},
                 {"expect", list("the expectations", expectation()), true}});
}

Json study_file() {
  Json study = object(
      "A scenario whose cells are drawn, and how sure each expectation must be",
      {version("zwang_study"),
       {"scenario", word("the path of a scenario file; else its keys stand here")},
       {"cell", word("of the scenario's matrix; default each as often as the others")},
       {"runs", Json{{"type", "integer"}, {"minimum", 1}, {"description", "cells"}}, true},
       {"sequence", one_of_words("how cells are drawn; default random", {"random", "halton"})},
       {"probability",
        certainty("of each expectation that says none: the share of runs in which it must hold")},
       {"confidence", certainty("with which that must be shown; default 95 %")},
       {"draw",
        named("what is drawn: params.NAME, start.x, robot.mass, scene.OBJECT.stiffness, state.delay ..",
              draw())}});
  const Json scenario = scenario_file();
  for (const auto& [key, value] : scenario["properties"].items()) {
    if (key != "zwang_scenario") study["properties"][key] = value;
  }
  study["properties"]["expect"] = list("the expectations", expectation(true));
  return study;
}

}  // namespace zwang::lang::schema
