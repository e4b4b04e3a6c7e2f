// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What both plugins need to speak MeshLab's language: failures as MLException, progress as the
/// progress bar, parameters that a script may leave out.
#pragma once

#include <wavemesh/codec.h>

#include <common/mlexception.h>
#include <common/parameters/rich_parameter_list.h>

#if __has_include(<common/parameters/rich_parameter/rich_file_save.h>)
#include <common/parameters/rich_parameter/rich_file_save.h>
#endif

#include <wrap/callback.h>

#include <QString>
#include <QVariant>

#include <cstdint>
#include <new>
#include <string>
#include <utility>

namespace wavemesh {

/// A file to write, as a parameter with a button: MeshLab 2022.02 has it under another name.
#if __has_include(<common/parameters/rich_parameter/rich_file_save.h>)
using SaveFileParameter = RichFileSave;
#else
using SaveFileParameter = RichSaveFile;
#endif

/// A status in a user's words, with what to do about it where that is known.
QString explain(const Status& status);

/// Throws an MLException, "<doing>: <explanation>", unless `status` is ok.
void require(const Status& status, const QString& doing);

/// Runs `work`, the body of a plugin's entry point. MeshLab survives an MLException and nothing
/// else, so whatever else is thrown becomes one.
template <class Work>
auto guarded(Work&& work) -> decltype(work())
{
	try {
		return std::forward<Work>(work)();
	}
	catch (const MLException&) {
		throw;
	}
	catch (const std::bad_alloc&) {
		throw MLException("Wavemesh: there is not enough memory for this mesh.");
	}
	catch (const std::exception& e) {
		throw MLException(QString("Wavemesh: internal error: ") + e.what());
	}
	catch (...) {
		throw MLException("Wavemesh: internal error.");
	}
}

/// MeshLab's progress bar as the codec's callback; it moves in whole percent. `bar` may be null.
/// `doing` stands beside it.
Progress progressBar(vcg::CallBackPos* bar, std::string doing);

/// Values of parameters; `missing` where a script does not give the parameter. A number may have
/// been given as an int, a float or an enum.
double numberOf(const RichParameterList& list, const QString& name, double missing);
int integerOf(const RichParameterList& list, const QString& name, int missing);
bool flagOf(const RichParameterList& list, const QString& name, bool missing);
QString textOf(const RichParameterList& list, const QString& name, const QString& missing);

/// A count for a result map: an int as long as it fits, as scripts expect.
QVariant countValue(std::uint64_t count);

/// Seconds since `start`, for log lines.
class Stopwatch
{
public:
	Stopwatch();
	double seconds() const;

private:
	std::int64_t start_;
};

} // namespace wavemesh
