"""The paper's own discrete form, eqs. (21)-(28) with appendix A: the baseline, faithful and not fast."""
