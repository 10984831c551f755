use std::path::Path;
use std::time::Instant;
fn main() {
    for folder in std::env::args().skip(1) {
        let t = Instant::now();
        let data = vuris::diagnose::Data::read(Path::new(&folder)).unwrap();
        let noise = vuris::diagnose::stated_noise(&data);
        let j = vuris::diagnose::judge(&data, noise);
        let found = &j.found;
        println!(
            "== {folder} {:.1} s {:?} chi2/n {:.5} -> {:.5} jitter {:.2e} m, remainder {:.4}",
            t.elapsed().as_secs_f64(),
            j.verdict,
            found.baseline.chi2 / found.baseline.samples as f64,
            found.fit.chi2 / found.fit.samples as f64,
            found.fit.jitter_m2.sqrt(),
            j.remainder
        );
        let mut alone = found.alone.clone();
        alone.sort_by(|a, b| b.3.total_cmp(&a.3));
        for a in alone.iter().take(3) {
            println!("   alone {:?}", a);
        }
        for n in &found.named {
            println!("   found {:?}", n);
        }
        for n in &j.named {
            println!("   NAMED {}", n.name);
        }
        for p in &found.fit.pieces {
            println!("   fit {} {:?}", p.effect.name, p.values);
        }
        for c in j.places.iter().take(4) {
            println!("   place {:12} {:9.2} {:?} {}", c.coordinate, c.ln_bayes, c.chi2, c.shape);
        }
        for c in j.left.iter().take(4) {
            println!("   left  {:12} {:9.2} {:?} {}", c.coordinate, c.ln_bayes, c.chi2, c.shape);
        }
        println!("   invisible {:?}", found.invisible);
    }
}
