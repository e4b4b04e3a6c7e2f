// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Choices in one word for the save dialog, each a set of options of the encoder.
#pragma once

#include <wavemesh/codec.h>

#include <QString>
#include <QStringList>

namespace wavemesh {

enum class Preset { Custom, Smallest, Balanced, BestCoarseLevels, Exact };

/// In the order of Preset.
QStringList presetNames();

/// What each of them does, what it is for, and what it costs: HTML.
QString presetHelp();

/// The options that the preset stands for. Precision (bits or step) and order stay as they are;
/// Custom changes nothing.
EncodeOptions optionsOf(Preset preset, EncodeOptions options);

} // namespace wavemesh
