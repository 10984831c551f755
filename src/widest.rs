//! Loops over pixels with the widest registers that the machine has.

/// Does the work of a block with the widest registers that the machine has. Of variables the block knows those that are named before it, with their types; one
/// of them at least is borrowed, for `'a`. Functions of this crate that it calls must be `#[inline(always)]`. Without fused operations, which the compiler never
/// makes by itself, the bits are the same on all machines.
///
/// A closure that is given to `pulp` does not do: the compiler need not put it into the function that is made for these registers, and as a rule does not. Nor
/// do closures within the block that are not small.
macro_rules! widest {
    (($($name:ident: $type:ty),+ $(,)?) $work:block) => {{
        struct Work<'a> {
            $($name: $type),+
        }
        impl<'a> pulp::NullaryFnOnce for Work<'a> {
            type Output = ();

            #[inline(always)]
            fn call(self) {
                let Self { $($name),+ } = self;
                $work
            }
        }
        pulp::Arch::new().dispatch(Work { $($name),+ });
    }};
}

pub(crate) use widest;

#[cfg(test)]
mod tests {
    #[test]
    fn the_work_is_done() {
        let (mut sums, values, factor) = (vec![1.0; 37], vec![2.0; 37], 3.0);
        {
            let (sums, values) = (&mut sums[..], &values[..]);
            widest!((sums: &'a mut [f64], values: &'a [f64], factor: f64) {
                for (sum, value) in sums.iter_mut().zip(values) {
                    *sum += factor * value;
                }
            });
        }
        assert_eq!(sums, vec![7.0; 37]);
    }
}
