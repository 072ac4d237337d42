/// Clients of services and topics as rmw_fastrtps makes them. They share nothing with zwang's side of the
/// wire but the encoding.
#pragma once

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>

#include <chrono>
#include <cstring>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "cdr.hpp"

namespace zwang::connect::test {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

class RawType : public dds::TopicDataType {
 public:
  explicit RawType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = 65536;
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

/// A participant on 127.0.0.1 that takes all that it has with it when it ends.
class Peer {
 public:
  explicit Peer(int domain) {
    dds::DomainParticipantQos qos = dds::PARTICIPANT_QOS_DEFAULT;
    qos.transport().use_builtin_transports = false;
    auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    udp->interfaceWhiteList = {"127.0.0.1"};
    qos.transport().user_transports.push_back(udp);
    participant_ = dds::DomainParticipantFactory::get_instance()->create_participant(
        static_cast<std::uint32_t>(domain), qos);
    publisher_ = participant_->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
    subscriber_ = participant_->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
  }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;
  ~Peer() {
    participant_->delete_contained_entities();
    dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  dds::DataReader& reader(const std::string& name, const std::string& type, bool wants_last = false) {
    dds::DataReaderQos qos = like_a_service(dds::DATAREADER_QOS_DEFAULT);
    if (wants_last) qos.durability().kind = dds::TRANSIENT_LOCAL_DURABILITY_QOS;
    return *subscriber_->create_datareader(topic(name, type), qos);
  }
  dds::DataWriter& writer(const std::string& name, const std::string& type) {
    return *publisher_->create_datawriter(topic(name, type), like_a_service(dds::DATAWRITER_QOS_DEFAULT));
  }

 private:
  template <typename Qos>
  static Qos like_a_service(Qos qos) {
    qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
    qos.history().depth = 10;
    qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    qos.data_sharing().off();
    return qos;
  }
  dds::Topic* topic(const std::string& name, const std::string& type) {
    dds::TypeSupport(new RawType(type)).register_type(participant_);
    return participant_->create_topic(name, type, dds::TOPIC_QOS_DEFAULT);
  }

  dds::DomainParticipant* participant_;
  dds::Publisher* publisher_;
  dds::Subscriber* subscriber_;
};

/// The next message of a reader; nullopt after so many seconds.
inline std::optional<Bytes> next_message(dds::DataReader& reader, double seconds, dds::SampleInfo& info) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (std::chrono::steady_clock::now() < until) {
    if (!reader.wait_for_unread_message(eprosima::fastrtps::Duration_t(0.1))) continue;
    Bytes bytes;
    const bool is_there =
        reader.take_next_sample(&bytes, &info) == eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;
    if (is_there && info.valid_data) return bytes;
  }
  return std::nullopt;
}

/// A client of one service. `type`: as DDS knows it, `std_srvs::srv::dds_::Trigger_`.
class RawClient {
 public:
  RawClient(Peer& peer, const std::string& service, const std::string& type)
      : reader_(peer.reader("rr" + service + "Reply", type + "Response_")),
        writer_(peer.writer("rq" + service + "Request", type + "Request_")) {}

  bool wait_for_server() {
    dds::PublicationMatchedStatus matched;
    for (int i = 0; i < 1000 && matched.current_count == 0; ++i) {
      writer_.get_publication_matched_status(matched);
      if (matched.current_count == 0) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return matched.current_count > 0;
  }

  void ask(Bytes request) {
    rtps::WriteParams parameters;
    parameters.related_sample_identity().writer_guid() = reader_.guid();
    writer_.write(&request, parameters);
    number_ = parameters.sample_identity().sequence_number();
  }

  /// The reply to what was asked last.
  std::optional<Bytes> reply(double seconds = 10.0) {
    dds::SampleInfo info;
    while (auto bytes = next_message(reader_, seconds, info)) {
      const auto& of = info.related_sample_identity;
      if (of.writer_guid() == reader_.guid() && of.sequence_number() == number_) return bytes;
    }
    return std::nullopt;
  }

  std::optional<Bytes> call(Bytes request) {
    ask(std::move(request));
    return reply();
  }

 private:
  dds::DataReader& reader_;
  dds::DataWriter& writer_;
  rtps::SequenceNumber_t number_;
};

}  // namespace zwang::connect::test
