/* A robot's driver by Cyclone DDS, as rmw_cyclonedds would write it: `zwang drive` hears and commands nothing else.

     cyclone_robot DOMAIN INNER_DOMAIN ROUTE...

   ROUTE is `state:/TOPIC:TYPE` from the robot to the task, `command:/TOPIC:TYPE` from the task to the motors, or
   `output:/TOPIC:TYPE`, the same of what the task sets, which is kept for whoever comes late. TYPE is as
   `std_msgs/Bool`. The motors behind it are `zwang simulate` in another domain. Each message is read into the struct
   that Cyclone's own compiler made of the IDL, and written anew from it: what either side encodes, Cyclone has
   understood. SIGTERM ends it. It prints how many messages of each topic passed. */
#include <dds/dds.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "robot.h"

static const struct {
  const char* name;
  const dds_topic_descriptor_t* descriptor;
} types[] = {
    {"rosgraph_msgs/Clock", &rosgraph_msgs_msg_dds__Clock__desc},
    {"sensor_msgs/JointState", &sensor_msgs_msg_dds__JointState__desc},
    {"geometry_msgs/PoseStamped", &geometry_msgs_msg_dds__PoseStamped__desc},
    {"sensor_msgs/LaserScan", &sensor_msgs_msg_dds__LaserScan__desc},
    {"nav_msgs/Odometry", &nav_msgs_msg_dds__Odometry__desc},
    {"tf2_msgs/TFMessage", &tf2_msgs_msg_dds__TFMessage__desc},
    {"geometry_msgs/PoseWithCovarianceStamped", &geometry_msgs_msg_dds__PoseWithCovarianceStamped__desc},
    {"geometry_msgs/Twist", &geometry_msgs_msg_dds__Twist__desc},
    {"geometry_msgs/TwistStamped", &geometry_msgs_msg_dds__TwistStamped__desc},
    {"geometry_msgs/WrenchStamped", &geometry_msgs_msg_dds__WrenchStamped__desc},
    {"std_msgs/Bool", &std_msgs_msg_dds__Bool__desc},
    {"std_msgs/Float64", &std_msgs_msg_dds__Float64__desc},
    {"std_msgs/Float64MultiArray", &std_msgs_msg_dds__Float64MultiArray__desc},
};

typedef struct {
  char topic[128];
  const dds_topic_descriptor_t* type;
  int is_to_motors;  /* 0: from the robot to the task */
  int is_kept;       /* for whoever comes late */
  dds_entity_t reader, writer;
  unsigned long passed;
} Route;

enum { most_routes = 32 };
static Route routes[most_routes];
static int count;

/* 0: it is no route. */
static int read_route(const char* word, Route* route) {
  char kind[16], topic[100], type[64];
  if (sscanf(word, "%15[^:]:%99[^:]:%63s", kind, topic, type) != 3) return 0;
  route->is_kept = strcmp(kind, "output") == 0;
  route->is_to_motors = route->is_kept || strcmp(kind, "command") == 0;
  if (!route->is_to_motors && strcmp(kind, "state") != 0) return 0;
  snprintf(route->topic, sizeof route->topic, "rt%s", topic);
  for (size_t i = 0; i < sizeof types / sizeof *types; ++i) {
    if (strcmp(types[i].name, type) == 0) route->type = types[i].descriptor;
  }
  return route->type != NULL;
}

static volatile sig_atomic_t is_over;

static void end(int number) {
  (void)number;
  is_over = 1;
}

/* ROS 2's defaults: sensors and commands by the latest value, nothing for whoever comes late. */
static dds_qos_t* like_ros(dds_reliability_kind_t kind, int depth, int is_kept) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, kind, DDS_MSECS(1));
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, depth);
  if (is_kept) dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  return qos;
}

static void open_route(Route* route, dds_entity_t outer, dds_entity_t inner, dds_entity_t waits) {
  const dds_entity_t from = route->is_to_motors ? outer : inner, to = route->is_to_motors ? inner : outer;
  const dds_reliability_kind_t kind = route->is_kept ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT;
  route->reader = dds_create_reader(from, dds_create_topic(from, route->type, route->topic, NULL, NULL),
                                    like_ros(kind, 10, route->is_kept), NULL);
  route->writer = dds_create_writer(to, dds_create_topic(to, route->type, route->topic, NULL, NULL),
                                    like_ros(DDS_RELIABILITY_RELIABLE, 1, route->is_kept), NULL);
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
  if (argc < 4 || argc - 3 > most_routes) return 2;
  for (count = 0; count < argc - 3; ++count) {
    if (!read_route(argv[3 + count], &routes[count])) {
      fprintf(stderr, "cyclone_robot: `%s` is no route\n", argv[3 + count]);
      return 2;
    }
  }
  signal(SIGTERM, end);
  const dds_entity_t outer = dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL);
  const dds_entity_t inner = dds_create_participant((dds_domainid_t)atoi(argv[2]), NULL, NULL);
  if (outer < 0 || inner < 0) return 2;
  /* Two domains have no entity in common but the library itself. */
  const dds_entity_t waits = dds_create_waitset(DDS_CYCLONEDDS_HANDLE);
  for (int i = 0; i < count; ++i) open_route(&routes[i], outer, inner, waits);
  while (!is_over) {
    dds_attach_t ready[most_routes];
    const dds_return_t changed = dds_waitset_wait(waits, ready, most_routes, DDS_MSECS(50));
    for (dds_return_t i = 0; i < changed && i < most_routes; ++i) pass_on((Route*)ready[i]);
  }
  for (int i = 0; i < count; ++i) {
    if (routes[i].passed > 0) printf("%s: %lu passed\n", routes[i].topic, routes[i].passed);
  }
  dds_delete(DDS_CYCLONEDDS_HANDLE);
  return 0;
}
