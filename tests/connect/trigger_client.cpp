// Calls a service of the type std_srvs/Trigger, and prints the last reply.
//
//   trigger_client DOMAIN SERVICE [CALLS]
//
// Ends with 0 for success, 1 for none, 2 as soon as a call has no reply.
#include <cstdio>
#include <cstdlib>

#include "raw_client.hpp"

namespace {

using namespace zwang::connect;

int call_in(int domain, const std::string& service, int calls) {
  test::Peer peer(domain);
  test::RawClient client(peer, service, "std_srvs::srv::dds_::Trigger_");
  client.wait_for_server();
  bool success = false;
  std::string message;
  for (int i = 0; i < calls; ++i) {
    const auto reply = client.call({0, 1, 0, 0, 0});
    if (!reply) {
      std::printf("no reply to call %d\n", i + 1);
      return 2;
    }
    CdrReader read(*reply);
    read(success), read(message);
    if (!read.is_at_end()) return 2;
  }
  std::printf("%s: %s\n", success ? "success" : "refused", message.c_str());
  return success ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  return argc >= 3 ? call_in(std::atoi(argv[1]), argv[2], argc > 3 ? std::atoi(argv[3]) : 1) : 2;
}
