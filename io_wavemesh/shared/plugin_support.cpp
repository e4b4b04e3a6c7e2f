// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin_support.h"

#include <chrono>
#include <cmath>
#include <limits>

namespace wavemesh {
namespace {

/// What a mesh is not that has to be an oriented manifold, as the codec says it, and the filters of
/// MeshLab against it.
constexpr struct
{
	const char *what, *filters;
} kNoManifold[] = {
    {"belongs to no face", "'Remove Unreferenced Vertices'"},
    {"is degenerate", "'Remove Zero Area Faces'"},
    {"is non-manifold or its faces are oriented inconsistently",
     "'Remove Duplicate Faces', 'Re-Orient all faces coherently' or 'Repair non "
     "Manifold Edges'"},
    {"its faces form several fans", "'Repair non Manifold Vertices by splitting'"}};

QString manifoldAdvice(const QString& what)
{
	QString advice = " The mesh has to be an oriented manifold.";
	for (const auto& wrong : kNoManifold)
		if (what.contains(wrong.what))
			advice += QString(" Apply the filter ") + wrong.filters + ", then this one again.";
	return advice;
}

} // namespace

QString explain(const Status& status)
{
	QString text = QString::fromStdString(status.what);
	if (text.isEmpty())
		text = QString("error %1").arg(int(status.code));
	if (!text.endsWith('.'))
		text += '.';
	switch (status.code) {
	case StatusCode::Unsupported:
		return text + manifoldAdvice(text);
	case StatusCode::VersionTooNew:
		return text + " A newer Wavemesh is needed to read it.";
	case StatusCode::VersionTooOld:
		return text + " Save the original again, or open the file with the Wavemesh that wrote it.";
	case StatusCode::OutOfMemory:
		return text + " Open it at a coarser level, or close other layers.";
	default:
		return text;
	}
}

void require(const Status& status, const QString& doing)
{
	if (!status.ok())
		throw MLException(doing + ": " + explain(status));
}

Progress progressBar(vcg::CallBackPos* bar, std::string doing)
{
	if (bar == nullptr)
		return {};
	return [bar, doing = std::move(doing), shown = -1](double fraction) mutable {
		const int percent = int(100 * fraction);
		if (percent != shown)
			bar(shown = percent, doing.c_str());
		return true;
	};
}

double numberOf(const RichParameterList& list, const QString& name, double missing)
{
	if (!list.hasParameter(name))
		return missing;
	const Value& value = list.getParameterByName(name).value();
	if (value.isInt())
		return value.getInt();
	if (value.isFloat())
		return double(value.getFloat());
	throw MLException("Wavemesh: the parameter '" + name + "' has to be a number.");
}

int integerOf(const RichParameterList& list, const QString& name, int missing)
{
	const double number = numberOf(list, name, missing);
	if (!(std::fabs(number) <= std::numeric_limits<int>::max()))
		throw MLException("Wavemesh: the parameter '" + name + "' is out of range.");
	return int(std::lround(number));
}

bool flagOf(const RichParameterList& list, const QString& name, bool missing)
{
	if (!list.hasParameter(name))
		return missing;
	const Value& value = list.getParameterByName(name).value();
	if (!value.isBool())
		throw MLException("Wavemesh: the parameter '" + name + "' has to be true or false.");
	return value.getBool();
}

QString textOf(const RichParameterList& list, const QString& name, const QString& missing)
{
	if (!list.hasParameter(name))
		return missing;
	const Value& value = list.getParameterByName(name).value();
	if (!value.isString())
		throw MLException("Wavemesh: the parameter '" + name + "' has to be a text.");
	return value.getString();
}

QVariant countValue(std::uint64_t count)
{
	if (count <= std::uint64_t(std::numeric_limits<int>::max()))
		return QVariant(int(count));
	return QVariant(double(count));
}

static std::int64_t nowNanoseconds()
{
	const auto now = std::chrono::steady_clock::now().time_since_epoch();
	return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

Stopwatch::Stopwatch() : start_(nowNanoseconds()) {}

double Stopwatch::seconds() const
{
	return 1e-9 * double(nowNanoseconds() - start_);
}

} // namespace wavemesh
