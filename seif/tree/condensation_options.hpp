// What can be set of the condensation tree.
#pragma once

namespace seif {

struct CondensationOptions {
  int most_in_leaf = 4;  // [-] landmarks of a leaf as it grows
  int most_hot = 24;     // [-] landmarks beyond which leaves without an active one do not stay hot
  /// [-] Unknowns of a front above which landmarks far from the robot are tied to groups.
  int most_unknowns = 120;
  double grain = 0.1;  // [-] distance over size of the coarsest groups
  /// What was frozen turns with the part of the map that it is in; otherwise it stays as it was turned then.
  bool turns = true;
  /// [-] Blocks that one update may touch before it stops to prepare the next zone; a quarter of them is always left
  /// for that, and a third more when the robot would arrive before the zone is ready, or a closure has bent the zone.
  /// 0: all at once, as soon as a landmark outside the zone is seen.
  int most_blocks = 26'000;
  // In multiples of the range that the robot sees:
  double zone_before = 0.75;  // how far before the robot the zone has its middle
  double look_ahead = 0.8;    // leaves so near to it are wanted in the zone,
  double zone_ahead = 1.35;   // and those so near are taken into the next one
};

}  // namespace seif
