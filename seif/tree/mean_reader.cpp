#include "seif/tree/mean_reader.hpp"

#include "seif/tree/room.hpp"

namespace seif {

void MeanReader::read(int at, Means means) {
  const Condensed& message = records_.sent(at).message;
  ++blocks_touched_;
  if (message.e == 0 && message.tied.empty()) return;
  const BodyMotion motion = find_step(message, means);
  GroupMotion mean = GroupMotion::Zero();
  Eigen::Index row = 0;
  for (const FrontVariable v : message.eliminated) {
    if (is_group(v)) {
      mean = records_.node(~v).group.mean + step_.segment<4>(row);
    } else {
      mean.head<2>() = records_.landmark(v).mean + step_.segment<2>(row);
    }
    set(v, means, mean, motion);
    row += freedom(v);
  }
  const bool turning = records_.options.turns;
  for (const Condensed::Tie& tie : message.tied)
    set(tie.variable, means, tie.reference + tied_motion(tie.lever, step_.segment<4>(tie.row), turning),
        motion);
  blocks_touched_ += message.reading_blocks();
}

/// The steps of E and B since the message was sent: d_E = L^-T (y - G d_B).
BodyMotion MeanReader::find_step(const Condensed& message, Means means) {
  const Eigen::Index e = message.e;
  const Eigen::Index b = message.b;
  make_room(step_, e + b);
  auto d_E = step_.head(e);
  auto d_B = step_.segment(e, b);
  records_.list_places(message, means, places_);
  const BodyMotion motion = boundary_.fit(records_.turning(), places_);
  boundary_.steps(places_, d_B);
  const auto columns = message.L_and_G();
  d_E = Eigen::Map<const Eigen::VectorXd>(message.y.data(), e);
  d_E.noalias() -= columns.bottomRows(b).transpose() * d_B;
  columns.topRows(e).triangularView<Eigen::Lower>().transpose().solveInPlace(d_E);
  return motion;
}

/// With the motion of the body that it is in.
void MeanReader::set(FrontVariable v, Means means, const GroupMotion& mean, const BodyMotion& motion) const {
  const bool planned = means == Means::planned;
  if (is_group(v)) {
    const LandmarkGroup& group = records_.node(~v).group;
    GroupMotion& to = planned ? group.planned : group.read;
    to = mean;
    if (motion.is_identity()) return;  // no rounding
    to.head<2>() = motion.moved(group.start + mean.head<2>()) - group.start;
    to(2) += motion.angle;
  } else {
    const CondensedLandmark& p = records_.landmark(v);
    (planned ? p.planned : p.read) = motion.moved(mean.head<2>());
  }
}

}  // namespace seif
