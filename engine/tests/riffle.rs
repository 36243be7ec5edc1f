//! A riffle of leaves that no hand holds is drawn where its paper is.

use turnleaf_engine::Stock;
use turnleaf_engine::trials::Riffle;

#[test]
fn leaves_of_a_riffle_are_not_drawn_behind_their_paper() {
    for leaves in [2, 3, 4, 5, 6, 8, 10, 12] {
        let mut riffle = Riffle::new(Stock::BOOK, leaves);
        for frame in 0..120 {
            riffle.frame();
            let book = riffle.book();
            let lags = (0..book.flights()).filter_map(|index| book.lag(index));
            let lag = lags.fold(0.0, f32::max);
            assert!(lag < 1e-3, "{leaves} leaves, frame {frame}: {lag} m");
        }
    }
}
