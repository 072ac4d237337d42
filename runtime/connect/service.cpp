#include "service.hpp"

#include <utility>

namespace zwang::connect {

namespace {

constexpr std::size_t cyclone_header = 16;  // a multiple of 8: the fields stay aligned without it

}  // namespace

bool is_cyclone(const Sender& sender) {
  return sender[0] == 0x01 && sender[1] == 0x10;
}

std::optional<ServiceCall> take_apart(std::span<const std::uint8_t> request, const Sender& sender) {
  CdrReader read(request);
  ServiceCall call;
  call.is_cyclone = is_cyclone(sender);
  if (call.is_cyclone) read(call.client), read(call.number);
  if (!read.is_good()) return std::nullopt;
  call.fields.assign(request.begin(), request.begin() + cdr_header);
  const std::size_t first = cdr_header + (call.is_cyclone ? cyclone_header : 0);
  call.fields.insert(call.fields.end(), request.begin() + static_cast<std::ptrdiff_t>(first), request.end());
  return call;
}

Bytes reply_payload(const ServiceCall& call, const Bytes& fields) {
  Bytes bytes;
  CdrWriter write(bytes);
  if (call.is_cyclone) write(call.client), write(call.number);
  bytes.insert(bytes.end(), fields.begin() + cdr_header, fields.end());
  return bytes;
}

Handler trigger_handler(std::function<TriggerReply()> answer) {
  return [answer = std::move(answer)](std::span<const std::uint8_t>, const Reply& reply) {
    const TriggerReply told = answer();
    Bytes fields;
    CdrWriter write(fields);
    write(told.success);
    write(told.message);
    reply(fields);
  };
}

std::string dds_request(const std::string& service) {
  return "rq" + service + "Request";
}

std::string dds_reply(const std::string& service) {
  return "rr" + service + "Reply";
}

}  // namespace zwang::connect
