/// The kind of drive, told from the places and axles of wheels alone.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "zwang/lang/robot_draft.hpp"

namespace zwang::lang {

enum class DriveKind { none, differential, rollers_or_skid, omni, swivels, car, other };

DriveKind drive_of(const std::vector<DraftWheel>& wheels);
/// The rolling direction [rad] of wheels with parallel axles, in the base, within (-90, 90] deg. 0: it is
/// ahead, or the base has no such direction.
double heading_of(DriveKind drive, const std::vector<DraftWheel>& wheels);

std::string in_words(DriveKind drive, const std::vector<DraftWheel>& wheels);

/// How many wheels each steering joint carries.
std::map<std::string, int> swivels_of(const std::vector<DraftWheel>& wheels);

}  // namespace zwang::lang
