#include "service.hpp"

namespace zwang::connect {

bool is_cyclone(const Sender& sender) {
  return sender[0] == 0x01 && sender[1] == 0x10;
}

std::optional<Bytes> trigger_reply(std::span<const std::uint8_t> request, const Sender& sender,
                                   const TriggerReply& reply) {
  CdrReader read(request);
  std::uint64_t client = 0;
  std::int64_t number = 0;
  if (is_cyclone(sender)) read(client), read(number);
  if (!read.is_good()) return std::nullopt;
  Bytes bytes;
  CdrWriter write(bytes);
  if (is_cyclone(sender)) write(client), write(number);
  write(reply.success);
  write(reply.message);
  return bytes;
}

std::string dds_request(const std::string& service) {
  return "rq" + service + "Request";
}

std::string dds_reply(const std::string& service) {
  return "rr" + service + "Reply";
}

}  // namespace zwang::connect
