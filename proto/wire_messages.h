#pragma once

#include <cstddef>

#include "proto/wire.pb.h"
#include "proto/wire_codec.h"
#include "proto/wire_skeleton.h"

namespace tandem::wire {

/// Private to proto/wire_codec.cpp: the skeletons of all messages, learned from the protobuf library itself.
struct Codec::Messages {
  std::size_t axes = 0;
  double position_max = 0;  ///< of a port sample [m] or [rad]
  pb::State state;
  pb::Force force;
  pb::Path path;
  pb::AuthorityChange authority;
  pb::Close close;
  Skeleton<state_size(kAxesMax) - kPreambleSize> state_skeleton;
  Skeleton<force_size(kAxesMax) - kPreambleSize> force_skeleton;
  Skeleton<kPathSize - kPreambleSize> path_skeleton;
  Skeleton<kAuthoritySize - kPreambleSize> authority_skeleton;
  Skeleton<kCloseSize - kPreambleSize> close_skeleton;

  Messages();
  /// Learns the layout of STATE and FORCE for that many axes. No heap.
  void configure(std::size_t axes_now, double position_max_now) noexcept;
};

}  // namespace tandem::wire
