// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Choices in one word for the save dialog, each a set of options of the encoder.
#pragma once

#include <wavemesh/codec.h>

#include <QString>
#include <QStringList>

#include <vector>

namespace wavemesh {

enum class Preset { Custom, Smallest, Balanced, BestCoarseLevels, Exact };

/// In the order of Preset.
QStringList presetNames();

/// What each of them does, what it is for, and what it costs: HTML.
QString presetHelp();

/// The options that the preset stands for; of several, the ones that give the smallest file are
/// meant. Precision (bits or step) stays as it is but for Exact; Custom changes nothing.
std::vector<EncodeOptions> optionsOf(Preset preset, EncodeOptions options);

} // namespace wavemesh
