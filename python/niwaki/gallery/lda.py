"""Latent Dirichlet allocation, which finds the topics of documents: words that appear together.

There are ten topics over a hundred words, and twenty words in a document (dissertation, appendix A). Every latent
variable is a choice: the topics' words, the documents' topics, the topic of each word.
"""

from niwaki import model
from niwaki.gallery import data
from niwaki.methods import mh
from niwaki.words import Categorical, Dirichlet, categorical, observe, sample

TITLE = "ten topics of a few documents"
METHOD = mh(steps=400_000, warmup=100_000)

DOCUMENTS = data.documents(50)
TOPICS = 10
VOCABULARY = 100
FLAT_WORDS = Dirichlet([1.0] * VOCABULARY)
FLAT_TOPICS = Dirichlet([1.0] * TOPICS)


@model
def lda(documents=5):
    """Draw the topics, as probabilities of words, and the share of each topic in each document."""
    topics = [sample(FLAT_WORDS) for _ in range(TOPICS)]
    shares = [document(DOCUMENTS[d], topics) for d in range(documents)]
    return topics, shares


def document(words, topics):
    """Draw the share of each topic in a document, and observe its words."""
    share = sample(FLAT_TOPICS)
    for word in words:
        topic = categorical(share)
        observe(Categorical(topics[topic]), word)
    return share


MODEL = lda
