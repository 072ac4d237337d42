#include "base_teller.hpp"

#include <chrono>

#include "signal_sample.hpp"

namespace zwang::connect {

BaseTeller::BaseTeller(const lang::BasePublication& publication, const std::string& base_frame,
                       Participant& participant)
    : period_(1.0 / publication.rate) {
  odometry_.header.frame = publication.frames ? publication.frames->parent : "odom";
  odometry_.child_frame = publication.frames ? publication.frames->child : base_frame;
  transform_.header.frame = odometry_.header.frame;
  transform_.child_frame = odometry_.child_frame;
  if (publication.odometry)
    odometry_writer_ =
        participant.advertise(publication.odometry->name, lang::to_string(lang::MessageType::odometry));
  if (publication.frames)
    transform_writer_ = participant.advertise("/tf", lang::to_string(lang::MessageType::tf_message));
  thread_ = std::thread([this] { tell_each_period(); });
}

BaseTeller::~BaseTeller() {
  is_over_ = true;
  thread_.join();
}

void BaseTeller::note(double stamp, const solver::State& state) noexcept {
  BaseSample& draft = mail_.draft();
  draft.stamp = stamp;
  draft.pose = state.base_pose;
  draft.twist = state.base_twist;
  mail_.put();
}

void BaseTeller::tell(const BaseSample& base) {
  if (odometry_writer_) {
    odometry_.header = header_at(base.stamp, odometry_.header.frame);
    odometry_.pose = fields_of(base.pose);
    odometry_.twist = fields_of(base.twist);
    encode(odometry_, bytes_);
    odometry_writer_->write(bytes_);
  }
  if (transform_writer_) {
    transform_.header = header_at(base.stamp, transform_.header.frame);
    transform_.transform = fields_of(base.pose);
    encode(TransformsMessage{{transform_}}, bytes_);
    transform_writer_->write(bytes_);
  }
}

/// Nothing new, nothing told: a listener of /tf takes each stamp once.
void BaseTeller::tell_each_period() {
  while (!is_over_) {
    std::this_thread::sleep_for(std::chrono::duration<double>(period_));
    if (mail_.take()) tell(mail_.value());
  }
}

}  // namespace zwang::connect
