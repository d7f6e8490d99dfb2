"""stub"""
def peer_jobs(out, works, quick, references):
    return [], []
