def labels_of(unit): return {}
