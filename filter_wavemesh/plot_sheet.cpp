// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot_sheet.h"

#include <common/mlexception.h>

#include <QFileInfo>
#include <QGuiApplication>
#include <QImage>
#include <QPainter>
#include <QSaveFile>
#include <QTextStream>

namespace wavemesh {
namespace {

constexpr char kFontFamily[] = "DejaVu Sans";

class BitmapSheet : public PlotSheet
{
public:
	BitmapSheet(const QString& file, const QSizeF& size, int width) :
	        file_(file), image_(
	                         width,
	                         qRound(width * size.height() / size.width()),
	                         QImage::Format_ARGB32_Premultiplied),
	        painter_(&image_)
	{
		image_.fill(Qt::white);
		painter_.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing);
		painter_.scale(width / size.width(), width / size.width());
	}

	void fill(const QRectF& area, const QColor& colour) override
	{
		painter_.fillRect(area, colour);
	}

	void polyline(const QVector<QPointF>& points, const Stroke& stroke) override
	{
		painter_.setPen(penOf(stroke));
		painter_.setBrush(Qt::NoBrush);
		painter_.drawPolyline(QPolygonF(points));
	}

	void marker(const QPolygonF& outline, const QColor& fill, double contour) override
	{
		painter_.setPen(QPen(Qt::white, contour));
		painter_.setBrush(fill);
		painter_.drawPolygon(outline);
	}

	void text(
	    const QPointF& at,
	    const QString& line,
	    double size,
	    TextAnchor anchor,
	    bool bold,
	    bool upwards) override
	{
		// Sizes of fonts are whole pixels: taken large, and shrunk by the transformation.
		constexpr int kPixels = 64;
		QFont font(kFontFamily);
		font.setStyleHint(QFont::SansSerif);
		font.setPixelSize(kPixels);
		font.setBold(bold);
		const double width = QFontMetricsF(font).boundingRect(line).width();
		const double shift = anchor == TextAnchor::Left     ? 0
		                     : anchor == TextAnchor::Middle ? -width / 2
		                                                    : -width;
		painter_.save();
		painter_.translate(at);
		if (upwards)
			painter_.rotate(-90);
		painter_.scale(size / kPixels, size / kPixels);
		painter_.setFont(font);
		painter_.setPen(Qt::black);
		painter_.drawText(QPointF(shift, 0), line);
		painter_.restore();
	}

	void finish() override
	{
		painter_.end();
		QSaveFile out(file_);
		if (!out.open(QIODevice::WriteOnly) || !image_.save(&out, "PNG") || !out.commit())
			throw MLException("Cannot write " + file_ + ": " + out.errorString() + ".");
	}

private:
	static QPen penOf(const Stroke& stroke)
	{
		QPen pen(stroke.colour, stroke.width, Qt::SolidLine, Qt::FlatCap, Qt::RoundJoin);
		if (!stroke.dashes.isEmpty()) {
			QVector<qreal> inWidths;
			for (double length : stroke.dashes)
				inWidths << length / stroke.width;
			pen.setDashPattern(inWidths);
		}
		return pen;
	}

	QString file_;
	QImage image_;
	QPainter painter_;
};

class SvgSheet : public PlotSheet
{
public:
	SvgSheet(const QString& file, const QSizeF& size, int width) : file_(file), out_(&text_)
	{
		out_ << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
		     << QString("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%1\" height=\"%2\" "
		                "viewBox=\"0 0 %3 %4\" font-family=\"%5, sans-serif\">\n")
		            .arg(width)
		            .arg(qRound(width * size.height() / size.width()))
		            .arg(size.width())
		            .arg(size.height())
		            .arg(kFontFamily);
		fill(QRectF(QPointF(0, 0), size), Qt::white);
	}

	void fill(const QRectF& area, const QColor& colour) override
	{
		out_ << QString("<rect x=\"%1\" y=\"%2\" width=\"%3\" height=\"%4\" fill=\"%5\"/>\n")
		            .arg(area.x())
		            .arg(area.y())
		            .arg(area.width())
		            .arg(area.height())
		            .arg(colour.name());
	}

	void polyline(const QVector<QPointF>& points, const Stroke& stroke) override
	{
		QStringList dashes;
		for (double length : stroke.dashes)
			dashes << QString::number(length);
		out_ << "<polyline points=\"" << textOf(points)
		     << QString(
		            "\" fill=\"none\" stroke=\"%1\" stroke-width=\"%2\" stroke-linejoin=\"round\"")
		            .arg(stroke.colour.name())
		            .arg(stroke.width)
		     << (dashes.isEmpty() ? QString() : " stroke-dasharray=\"" + dashes.join(' ') + "\"")
		     << "/>\n";
	}

	void marker(const QPolygonF& outline, const QColor& fill, double contour) override
	{
		out_ << "<polygon points=\"" << textOf(outline)
		     << QString("\" fill=\"%1\" stroke=\"white\" stroke-width=\"%2\"/>\n")
		            .arg(fill.name())
		            .arg(contour);
	}

	void text(
	    const QPointF& at,
	    const QString& line,
	    double size,
	    TextAnchor anchor,
	    bool bold,
	    bool upwards) override
	{
		static const char* const anchors[] = {"start", "middle", "end"};
		out_ << QString("<text x=\"%1\" y=\"%2\" font-size=\"%3\" text-anchor=\"%4\"")
		            .arg(at.x())
		            .arg(at.y())
		            .arg(size)
		            .arg(anchors[int(anchor)])
		     << (bold ? " font-weight=\"bold\"" : "")
		     << (upwards ? QString(" transform=\"rotate(-90 %1 %2)\"").arg(at.x()).arg(at.y())
		                 : QString())
		     << ">" << line.toHtmlEscaped() << "</text>\n";
	}

	void finish() override
	{
		out_ << "</svg>\n";
		out_.flush();
		const QByteArray bytes = text_.toUtf8();
		QSaveFile file(file_);
		if (!file.open(QIODevice::WriteOnly) || file.write(bytes) != bytes.size() || !file.commit())
			throw MLException("Cannot write " + file_ + ": " + file.errorString() + ".");
	}

private:
	static QString textOf(const QVector<QPointF>& points)
	{
		QStringList words;
		for (const QPointF& p : points)
			words << QString("%1,%2").arg(p.x(), 0, 'f', 2).arg(p.y(), 0, 'f', 2);
		return words.join(' ');
	}

	QString file_;
	QString text_;
	QTextStream out_;
};

} // namespace

std::unique_ptr<PlotSheet> openPlotSheet(const QString& file, const QSizeF& size, int width)
{
	const QString suffix = QFileInfo(file).suffix().toLower();
	if (suffix == "svg")
		return std::make_unique<SvgSheet>(file, size, width);
	if (suffix != "png")
		throw MLException("Cannot draw " + file + ": a picture is a .png or an .svg file.");
	if (qobject_cast<QGuiApplication*>(QCoreApplication::instance()) == nullptr)
		throw MLException(
		    "Cannot draw " + file +
		    ": there are no fonts without a window system; name an .svg "
		    "file, or run in a program with one (-platform offscreen).");
	return std::make_unique<BitmapSheet>(file, size, width);
}

} // namespace wavemesh
