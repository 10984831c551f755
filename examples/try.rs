use std::path::Path;
use std::time::Instant;
fn main() {
    for folder in std::env::args().skip(1) {
        let t = Instant::now();
        let data = vuris::diagnose::Data::read(Path::new(&folder)).unwrap();
        let noise = vuris::diagnose::stated_noise(&data);
        let found = vuris::diagnose::search(&data, noise);
        println!(
            "== {folder} {:.1} s  chi2/n {:.5} -> {:.5} jitter {:.2e} m",
            t.elapsed().as_secs_f64(),
            found.baseline.chi2 / found.baseline.samples as f64,
            found.fit.chi2 / found.fit.samples as f64,
            found.fit.jitter_m2.sqrt()
        );
        let mut alone = found.alone.clone();
        alone.sort_by(|a, b| b.3.total_cmp(&a.3));
        for a in alone.iter().take(5) {
            println!("   alone {:?}", a);
        }
        for n in &found.named {
            println!("   NAMED {:?}", n);
        }
        for p in &found.fit.pieces {
            println!("   fit {} {:?}", p.effect.name, p.values);
        }
        println!("   invisible {:?}", found.invisible);
    }
}
