// Calls a service of the type std_srvs/Trigger as rmw_fastrtps does, and prints the reply.
//
//   trigger_client DOMAIN SERVICE
//
// Shares nothing with zwang's server but the encoding. Ends with 0 for success, 1 for none, 2 without a
// reply.
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <string>
#include <thread>

#include "cdr.hpp"

namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
using zwang::connect::Bytes;

class RawType : public dds::TopicDataType {
 public:
  explicit RawType(const char* name) {
    setName(name);
    m_typeSize = 4096;
    auto_fill_type_information(false);
    auto_fill_type_object(false);
  }
  bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    const auto& bytes = *static_cast<const Bytes*>(data);
    std::memcpy(payload->data, bytes.data(), bytes.size());
    payload->length = static_cast<std::uint32_t>(bytes.size());
    payload->encapsulation = CDR_LE;
    return true;
  }
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    static_cast<Bytes*>(data)->assign(payload->data, payload->data + payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(static_cast<const Bytes*>(data)->size()); };
  }
  void* createData() override { return new Bytes; }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
};

dds::DomainParticipant* participant_in(int domain) {
  dds::DomainParticipantQos qos = dds::PARTICIPANT_QOS_DEFAULT;
  qos.transport().use_builtin_transports = false;
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList = {"127.0.0.1"};
  qos.transport().user_transports.push_back(udp);
  return dds::DomainParticipantFactory::get_instance()->create_participant(static_cast<std::uint32_t>(domain),
                                                                           qos);
}

dds::Topic* topic(dds::DomainParticipant& participant, const std::string& name, const char* type) {
  dds::TypeSupport(new RawType(type)).register_type(&participant);
  return participant.create_topic(name, type, dds::TOPIC_QOS_DEFAULT);
}

template <typename Qos>
Qos like_a_service(Qos qos) {
  qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
  qos.history().depth = 10;
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.data_sharing().off();
  return qos;
}

int call(dds::DataWriter& writer, dds::DataReader& reader) {
  Bytes request{0, 1, 0, 0, 0};
  rtps::WriteParams parameters;
  parameters.related_sample_identity().writer_guid() = reader.guid();
  writer.write(&request, parameters);
  const auto number = parameters.sample_identity().sequence_number();
  while (reader.wait_for_unread_message(eprosima::fastrtps::Duration_t(2.0))) {
    Bytes reply;
    dds::SampleInfo info;
    if (reader.take_next_sample(&reply, &info) != eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK)
      continue;
    const auto& of = info.related_sample_identity;
    if (!info.valid_data || of.writer_guid() != reader.guid() || of.sequence_number() != number) continue;
    zwang::connect::CdrReader read(reply);
    bool success = false;
    std::string message;
    read(success), read(message);
    if (!read.is_at_end()) return 2;
    std::printf("%s: %s\n", success ? "success" : "refused", message.c_str());
    return success ? 0 : 1;
  }
  std::printf("no reply\n");
  return 2;
}

int call_in(int domain, const std::string& service) {
  dds::DomainParticipant* participant = participant_in(domain);
  dds::DataReader* reader = participant->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT)
                                ->create_datareader(topic(*participant, "rr" + service + "Reply",
                                                          "std_srvs::srv::dds_::Trigger_Response_"),
                                                    like_a_service(dds::DATAREADER_QOS_DEFAULT));
  dds::DataWriter* writer = participant->create_publisher(dds::PUBLISHER_QOS_DEFAULT)
                                ->create_datawriter(topic(*participant, "rq" + service + "Request",
                                                          "std_srvs::srv::dds_::Trigger_Request_"),
                                                    like_a_service(dds::DATAWRITER_QOS_DEFAULT));
  dds::PublicationMatchedStatus matched;
  for (int i = 0; i < 500; ++i) {
    writer->get_publication_matched_status(matched);
    if (matched.current_count > 0) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  const int code = call(*writer, *reader);
  participant->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(participant);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  return argc == 3 ? call_in(std::atoi(argv[1]), argv[2]) : 2;
}
