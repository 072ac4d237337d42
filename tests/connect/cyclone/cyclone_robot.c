/* A robot's driver by Cyclone DDS, as rmw_cyclonedds would write it: `zwang drive` hears and commands nothing else.

     cyclone_robot DOMAIN INNER_DOMAIN

   The motors behind it are `zwang simulate` in another domain. Each message is read into the struct that Cyclone's
   own compiler made of the IDL, and written anew from it: what either side encodes, Cyclone has understood.
   SIGTERM ends it. It prints how many messages of each topic passed. */
#include <dds/dds.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>

#include "robot.h"

typedef struct {
  const char* topic;
  const dds_topic_descriptor_t* type;
  int is_command; /* from the task to the motors; 0: from the robot to the task */
  dds_entity_t reader, writer;
  unsigned long passed;
} Route;

static Route routes[] = {
    {"rt/clock", &rosgraph_msgs_msg_dds__Clock__desc, 0, 0, 0, 0},
    {"rt/joint_states", &sensor_msgs_msg_dds__JointState__desc, 0, 0, 0, 0},
    {"rt/partner", &geometry_msgs_msg_dds__PoseStamped__desc, 0, 0, 0, 0},
    {"rt/latch", &std_msgs_msg_dds__Bool__desc, 0, 0, 0, 0},
    {"rt/loaded", &std_msgs_msg_dds__Bool__desc, 0, 0, 0, 0},
    {"rt/stop_key", &std_msgs_msg_dds__Bool__desc, 0, 0, 0, 0},
    {"rt/nearest", &std_msgs_msg_dds__Float64__desc, 0, 0, 0, 0},
    {"rt/effort_controller/commands", &std_msgs_msg_dds__Float64MultiArray__desc, 1, 0, 0, 0},
    {"rt/cmd_vel", &geometry_msgs_msg_dds__TwistStamped__desc, 1, 0, 0, 0},
};
enum { count = sizeof routes / sizeof *routes };

static volatile sig_atomic_t is_over;

static void end(int number) {
  (void)number;
  is_over = 1;
}

/* ROS 2's defaults: sensors and commands by the latest value, nothing for whoever comes late. */
static dds_qos_t* like_ros(dds_reliability_kind_t kind, int depth) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, kind, DDS_MSECS(1));
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, depth);
  return qos;
}

static void open_route(Route* route, dds_entity_t outer, dds_entity_t inner, dds_entity_t waits) {
  const dds_entity_t from = route->is_command ? outer : inner, to = route->is_command ? inner : outer;
  route->reader = dds_create_reader(from, dds_create_topic(from, route->type, route->topic, NULL, NULL),
                                    like_ros(DDS_RELIABILITY_BEST_EFFORT, 10), NULL);
  route->writer = dds_create_writer(to, dds_create_topic(to, route->type, route->topic, NULL, NULL),
                                    like_ros(DDS_RELIABILITY_RELIABLE, 1), NULL);
  dds_set_status_mask(route->reader, DDS_DATA_AVAILABLE_STATUS);
  dds_waitset_attach(waits, route->reader, (dds_attach_t)route);
}

static void pass_on(Route* route) {
  void* samples[10] = {NULL};
  dds_sample_info_t info[10];
  const dds_return_t taken = dds_take(route->reader, samples, info, 10, 10);
  for (dds_return_t i = 0; i < taken; ++i) {
    if (info[i].valid_data && dds_write(route->writer, samples[i]) == DDS_RETCODE_OK) ++route->passed;
  }
  if (taken > 0) dds_return_loan(route->reader, samples, taken);
}

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  signal(SIGTERM, end);
  const dds_entity_t outer = dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL);
  const dds_entity_t inner = dds_create_participant((dds_domainid_t)atoi(argv[2]), NULL, NULL);
  if (outer < 0 || inner < 0) return 2;
  /* Two domains have no entity in common but the library itself. */
  const dds_entity_t waits = dds_create_waitset(DDS_CYCLONEDDS_HANDLE);
  for (int i = 0; i < count; ++i) open_route(&routes[i], outer, inner, waits);
  while (!is_over) {
    dds_attach_t ready[count];
    const dds_return_t changed = dds_waitset_wait(waits, ready, count, DDS_MSECS(50));
    for (dds_return_t i = 0; i < changed && i < count; ++i) pass_on((Route*)ready[i]);
  }
  for (int i = 0; i < count; ++i) {
    if (routes[i].passed > 0) printf("%s: %lu passed\n", routes[i].topic, routes[i].passed);
  }
  dds_delete(DDS_CYCLONEDDS_HANDLE);
  return 0;
}
