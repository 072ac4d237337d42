/* A peer by Cyclone DDS, which shares nothing with zwang: it reads /zwang/state and /diagnostics, then calls a service of the type
   std_srvs/Trigger as rmw_cyclonedds does.

     cyclone_client DOMAIN SERVICE CALLS

   Prints the state and the health, then how many calls were answered and the last answer. Ends with 0 if all were. */
#include <dds/dds.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "messages.h"

static dds_entity_t participant;

static dds_qos_t* like_ros(int keeps_last) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 10);
  if (keeps_last) dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  return qos;
}

/* The next sample within some seconds, to be freed with its reader; NULL for none. */
static void* next_sample(dds_entity_t reader, double seconds) {
  static void* samples[1];
  dds_sample_info_t info;
  for (const dds_time_t until = dds_time() + (dds_time_t)(1e9 * seconds); dds_time() < until;) {
    if (samples[0] != NULL) dds_return_loan(reader, samples, 1);
    samples[0] = NULL;
    if (dds_take(reader, samples, &info, 1, 1) > 0 && info.valid_data) {
      void* sample = samples[0];
      samples[0] = NULL;
      return sample;
    }
    dds_sleepfor(DDS_USECS(100));
  }
  return NULL;
}

static void print_state(void) {
  dds_entity_t reader = dds_create_reader(
      participant, dds_create_topic(participant, &std_msgs_msg_dds__String__desc, "rt/zwang/state", NULL, NULL),
      like_ros(1), NULL);
  const std_msgs_msg_dds__String_* state = next_sample(reader, 10.0);
  printf("state %s\n", state != NULL ? state->data : "did not come");
}

static void print_health(void) {
  dds_entity_t reader = dds_create_reader(
      participant,
      dds_create_topic(participant, &diagnostic_msgs_msg_dds__DiagnosticArray__desc, "rt/diagnostics", NULL, NULL),
      like_ros(0), NULL);
  const diagnostic_msgs_msg_dds__DiagnosticArray_* health = next_sample(reader, 10.0);
  if (health == NULL || health->status._length != 1) {
    printf("health did not come\n");
    return;
  }
  const diagnostic_msgs_msg_dds__DiagnosticStatus_* status = health->status._buffer;
  printf("health %d %s: %s (%s, %u values)\n", status->level, status->name, status->message, status->hardware_id,
         (unsigned)status->values._length);
}

static int call(const char* service, int calls) {
  char request[256], reply[256];
  snprintf(request, sizeof request, "rq%sRequest", service);
  snprintf(reply, sizeof reply, "rr%sReply", service);
  dds_entity_t writer = dds_create_writer(
      participant, dds_create_topic(participant, &std_srvs_srv_dds__Trigger_Request__desc, request, NULL, NULL),
      like_ros(0), NULL);
  dds_entity_t reader = dds_create_reader(
      participant, dds_create_topic(participant, &std_srvs_srv_dds__Trigger_Response__desc, reply, NULL, NULL),
      like_ros(0), NULL);
  dds_publication_matched_status_t matched;
  for (int i = 0; i < 1000 && calls > 0; ++i) {
    dds_get_publication_matched_status(writer, &matched);
    if (matched.current_count > 0) break;
    dds_sleepfor(DDS_MSECS(10));
  }
  int answered = 0;
  const char* message = "";
  for (int i = 0; i < calls; ++i) {
    const std_srvs_srv_dds__Trigger_Request_ asked = {0x1122334455667788ULL, i + 1, 0};
    dds_write(writer, &asked);
    const std_srvs_srv_dds__Trigger_Response_* told = next_sample(reader, 2.0);
    if (told == NULL || told->client != asked.client || told->number != asked.number) continue;
    ++answered;
    message = told->message;
  }
  printf("%d of %d answered: %s\n", answered, calls, message);
  return answered == calls ? 0 : 1;
}

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  participant = dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL);
  if (participant < 0) return 2;
  print_state();
  print_health();
  const int code = call(argv[2], atoi(argv[3]));
  dds_delete(participant);
  return code;
}
