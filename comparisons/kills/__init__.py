"""Every fault and every legitimate variant, judged like a renderer on every scene."""
