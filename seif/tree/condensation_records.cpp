#include "seif/tree/condensation_records.hpp"

namespace seif {

CondensationRecords::CondensationRecords(const CondensationOptions& options_, const Pose2& start)
    : options(options_), tree(start) {
  for (int r = 0; r < most_rings; ++r) {
    tree.new_leaf();
    nodes.push_back({});
  }
}

int CondensationRecords::ring_of(int leaves) {
  int ring = 0;
  for (int size = most_bare; size < leaves && ring < most_rings - 1; size *= ring_ratio) ++ring;
  return ring;
}

int CondensationRecords::receiver(int at) const {
  if (is_ring(at)) return at - 1;
  const int above = tree.parent(at);
  return above != none && node(above).on_path ? node(above).ring : above;
}

void CondensationRecords::read_mean(FrontVariable v, Means means, double* to) const {
  const bool planned = means == Means::planned;
  if (is_group(v)) {
    const LandmarkGroup& group = node(~v).group;
    Eigen::Map<GroupMotion>{to} = planned ? group.planned : group.read;
  } else {
    const CondensedLandmark& p = landmark(v);
    Eigen::Map<CondensedLandmark::Point>{to} = planned ? p.planned : p.read;
  }
}

Eigen::Vector2d CondensationRecords::place(FrontVariable v, const double* mean) const {
  const Eigen::Vector2d p = Eigen::Map<const Eigen::Vector2d>(mean);
  return is_group(v) ? Eigen::Vector2d(node(~v).group.start + p) : p;
}

MovedPlace CondensationRecords::moved_place(FrontVariable v, const double* reference,
                                            const double* mean) const {
  MovedPlace moved{.before = place(v, reference), .now = place(v, mean)};
  if (!is_group(v)) return moved;
  moved.rows = freedom(v);
  moved.turn = mean[2] - reference[2];
  moved.dilation = mean[3] - reference[3];
  return moved;
}

void CondensationRecords::list_places(const Condensed& part, Means means,
                                      std::vector<MovedPlace>& places) const {
  places.clear();
  GroupMotion mean;
  const double* reference = part.reference.data();
  for (const Condensed::Member& m : part.boundary) {
    read_mean(m.variable, means, mean.data());
    places.push_back(moved_place(m.variable, reference, mean.data()));
    reference += freedom(m.variable);
  }
}

std::size_t CondensationRecords::memory_bytes() const {
  std::size_t bytes = tree.memory_bytes() + nodes.memory_bytes() + landmarks.memory_bytes();
  for (std::size_t i = 0; i < nodes.size(); ++i)
    bytes += nodes[i].sent.message.memory_bytes() + nodes[i].own.memory_bytes() +
             nodes[i].sent.groups.capacity() * sizeof(int);
  return bytes;
}

}  // namespace seif
