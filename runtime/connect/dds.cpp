#include "dds.hpp"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>

#include <atomic>
#include <cstring>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <mutex>
#include <stdexcept>
#include <vector>

#include "message.hpp"

namespace zwang::connect {

namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

constexpr std::uint32_t usual_payload = 4096;  // larger ones make their room larger
constexpr int input_depth = 10;
const eprosima::fastrtps::Duration_t longest_write(0, 1'000'000);  // 1 ms

/// A payload passes as it is: encoding is message.cpp's.
class RawType : public dds::TopicDataType {
 public:
  explicit RawType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = usual_payload;
    m_isGetKeyDefined = false;
    auto_fill_type_information(false);
    auto_fill_type_object(false);
  }
  bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    const auto& bytes = *static_cast<const std::span<const std::uint8_t>*>(data);
    if (bytes.size() > payload->max_size) return false;
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
    const auto size = static_cast<const std::span<const std::uint8_t>*>(data)->size();
    return [size] { return static_cast<std::uint32_t>(size); };
  }
  void* createData() override { return new Bytes; }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
};

class Listener : public dds::DataReaderListener {
 public:
  explicit Listener(std::function<void(std::span<const std::uint8_t>)> on_payload)
      : on_payload_(std::move(on_payload)) {}
  void on_data_available(dds::DataReader* reader) override {
    // Peers may be served by different threads of the transport.
    const std::lock_guard lock(mutex_);
    dds::SampleInfo info;
    while (reader->take_next_sample(&bytes_, &info) == eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
      if (info.valid_data) on_payload_(bytes_);
    }
  }

 private:
  std::function<void(std::span<const std::uint8_t>)> on_payload_;
  std::mutex mutex_;
  Bytes bytes_;
};

class CountingListener : public dds::DataWriterListener {
 public:
  void on_publication_matched(dds::DataWriter*, const dds::PublicationMatchedStatus& status) override {
    readers = status.current_count;
  }
  std::atomic<int> readers{0};
};

class DdsWriter : public Writer {
 public:
  DdsWriter(dds::Publisher& publisher, dds::Topic& topic) {
    dds::DataWriterQos qos = dds::DATAWRITER_QOS_DEFAULT;
    qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
    qos.reliability().max_blocking_time = longest_write;
    qos.history().depth = 1;  // only the latest command counts
    qos.publish_mode().kind = dds::ASYNCHRONOUS_PUBLISH_MODE;
    qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    qos.data_sharing().off();
    writer_ = publisher.create_datawriter(&topic, qos, &listener_);
    if (writer_ == nullptr) throw std::runtime_error("DDS gives no writer for " + topic.get_name());
  }
  bool write(std::span<const std::uint8_t> payload) noexcept override {
    try {
      return writer_->write(&payload);
    } catch (...) {
      return false;
    }
  }
  int readers() const noexcept override { return listener_.readers; }

 private:
  CountingListener listener_;
  dds::DataWriter* writer_ = nullptr;
};

dds::DomainParticipantQos participant_qos(lang::Reach reach, const std::string& name) {
  dds::DomainParticipantQos qos = dds::PARTICIPANT_QOS_DEFAULT;
  qos.name(name);
  // Shared memory would leave out peers by Cyclone, and every peer of another user.
  qos.transport().use_builtin_transports = false;
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  if (reach == lang::Reach::loopback) {
    udp->interfaceWhiteList = {"127.0.0.1"};
    udp->TTL = 0;
  }
  qos.transport().user_transports.push_back(udp);
  return qos;
}

}  // namespace

struct Participant::Parts {
  dds::DomainParticipant* participant = nullptr;
  dds::Publisher* publisher = nullptr;
  dds::Subscriber* subscriber = nullptr;
  std::vector<std::unique_ptr<Listener>> listeners;

  dds::Topic& topic(const std::string& name, lang::MessageType type) {
    const std::string full = dds_topic(name), type_name = dds_type(type);
    dds::TypeSupport(new RawType(type_name)).register_type(participant);
    if (auto* known = dynamic_cast<dds::Topic*>(participant->lookup_topicdescription(full))) return *known;
    dds::Topic* made = participant->create_topic(full, type_name, dds::TOPIC_QOS_DEFAULT);
    if (made == nullptr) throw std::runtime_error("DDS gives no topic " + full);
    return *made;
  }
};

Participant::Participant(int domain, lang::Reach reach, const std::string& name)
    : parts_(std::make_unique<Parts>()) {
  auto* factory = dds::DomainParticipantFactory::get_instance();
  const dds::DomainParticipantQos qos = participant_qos(reach, name);
  parts_->participant = factory->create_participant(static_cast<std::uint32_t>(domain), qos);
  if (parts_->participant == nullptr)
    throw std::runtime_error("DDS does not start in domain " + std::to_string(domain));
  parts_->publisher = parts_->participant->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
  parts_->subscriber = parts_->participant->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
}

Participant::~Participant() {
  close();
}

void Participant::close() noexcept {
  if (parts_->participant == nullptr) return;
  parts_->participant->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(parts_->participant);
  parts_->participant = nullptr;
}

void Participant::subscribe(const std::string& topic, lang::MessageType type,
                            std::function<void(std::span<const std::uint8_t>)> on_payload) {
  dds::DataReaderQos qos = dds::DATAREADER_QOS_DEFAULT;
  // Best effort finds writers of either kind, and a lost sample is not waited for.
  qos.reliability().kind = dds::BEST_EFFORT_RELIABILITY_QOS;
  qos.history().depth = input_depth;
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.data_sharing().off();
  parts_->listeners.push_back(std::make_unique<Listener>(std::move(on_payload)));
  dds::Topic& of = parts_->topic(topic, type);
  if (parts_->subscriber->create_datareader(&of, qos, parts_->listeners.back().get()) == nullptr)
    throw std::runtime_error("DDS gives no reader for " + topic);
}

std::unique_ptr<Writer> Participant::advertise(const std::string& topic, lang::MessageType type) {
  return std::make_unique<DdsWriter>(*parts_->publisher, parts_->topic(topic, type));
}

}  // namespace zwang::connect
