// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "rviz/gap_list.h"

#include <QPainter>
#include <QStyledItemDelegate>
#include <algorithm>
#include <utility>

#include "rviz/next_step.h"

namespace plumb::rviz_panel {
namespace {

constexpr int kRow_px = 50;
constexpr int kFewestRows = 2;
constexpr int kMargin_px = 6;

constexpr int kProblemRole = Qt::UserRole;
constexpr int kIndexRole = Qt::UserRole + 1;

// The first line bold, both shrunk until they fit.
class RowPainter : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

  void paint(QPainter* painter,
             const QStyleOptionViewItem& option,
             const QModelIndex& index) const override {
    const bool is_chosen = (option.state & QStyle::State_Selected) != 0;
    painter->save();
    painter->fillRect(option.rect, is_chosen ? Qt::black : Qt::white);
    painter->setPen(is_chosen ? Qt::white : Qt::black);
    const QRect inside = option.rect.adjusted(kMargin_px, 3, -kMargin_px, -3);
    const int middle = inside.center().y();
    DrawLine(index.data().toString(),
             QRect(inside.topLeft(), QPoint(inside.right(), middle)),
             QFont::Bold,
             option.font,
             painter);
    DrawLine(index.data(kProblemRole).toString(),
             QRect(QPoint(inside.left(), middle), inside.bottomRight()),
             QFont::Normal,
             option.font,
             painter);
    painter->setPen(Qt::black);
    painter->drawLine(option.rect.bottomLeft(), option.rect.bottomRight());
    painter->restore();
  }

  QSize sizeHint(const QStyleOptionViewItem&, const QModelIndex&) const override {
    return {0, kRow_px};
  }

 private:
  static void DrawLine(const QString& text,
                       const QRect& where,
                       QFont::Weight weight,
                       QFont font,
                       QPainter* painter) {
    font.setWeight(weight);
    const int width = QFontMetrics(font).horizontalAdvance(text);
    if (width > where.width()) font.setStretch(std::max(70, 100 * where.width() / width));
    painter->setFont(font);
    painter->drawText(where, Qt::AlignLeft | Qt::AlignVCenter, text);
  }
};

}  // namespace

GapList::GapList(std::function<void(std::size_t)> on_click) : list_(new QListWidget(this)) {
  list_->setObjectName("gaps");
  list_->setItemDelegate(new RowPainter(list_));
  list_->setUniformItemSizes(true);
  list_->setVerticalScrollMode(QAbstractItemView::ScrollPerItem);
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  connect(list_,
          &QListWidget::itemClicked,
          this,
          [on_click = std::move(on_click)](const QListWidgetItem* item) {
            on_click(static_cast<std::size_t>(item->data(kIndexRole).toULongLong()));
          });
}

// Where it was scrolled to stays: the gaps come anew with each photo.
void GapList::Show(const plumbline::Gaps& gaps, std::size_t first) {
  const int top = list_->indexAt(QPoint(0, 0)).row();
  list_->clear();
  for (std::size_t i = first; i < gaps.gaps.size(); ++i) {
    const plumbline::Gap& gap = gaps.gaps[i];
    auto* item =
        new QListWidgetItem(QString::fromStdString(GapName(i) + "  " + WayText(gap)), list_);
    item->setData(kProblemRole, QString::fromStdString(gap.problem));
    item->setData(kIndexRole, static_cast<qulonglong>(i));
  }
  FitRows();
  if (top > 0 && top < list_->count()) {
    list_->scrollToItem(list_->item(top), QAbstractItemView::PositionAtTop);
  }
}

QSize GapList::minimumSizeHint() const {
  return {0, kFewestRows * kRow_px + 2 * list_->frameWidth()};
}

void GapList::resizeEvent(QResizeEvent*) { FitRows(); }

void GapList::FitRows() {
  const int frame_px = 2 * list_->frameWidth();
  const int room = std::max(kFewestRows, (height() - frame_px) / kRow_px);
  const int num_rows = std::clamp(list_->count(), 1, room);
  list_->setGeometry(0, 0, width(), num_rows * kRow_px + frame_px);
  list_->setVisible(list_->count() > 0);
}

}  // namespace plumb::rviz_panel
